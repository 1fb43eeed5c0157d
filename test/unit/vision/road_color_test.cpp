// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/vision/road_color.h"

#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace datmo::road_color_test {
namespace {

constexpr int kSamples = 2000;
constexpr double kSigma = 6.0;  // gray levels
const Stamp kStart = Stamp::fromSeconds(1.0);

/// An equal number of samples around each of some gray levels.
PixelColors samplesAround(const std::vector<double>& levels) {
  std::mt19937 engine(1);
  std::normal_distribution<double> noise(0.0, kSigma);
  PixelColors samples;
  for (int i = 0; i < kSamples; ++i) {
    const double level = levels[static_cast<std::size_t>(i) % levels.size()];
    samples.push_back(PixelColor::Constant(1, std::round(level + noise(engine))));
  }
  return samples;
}

PixelColor gray(double level) { return PixelColor::Constant(1, level); }

PixelColor bgr(double blue, double green, double red) {
  PixelColor color(3);
  color << blue, green, red;
  return color;
}

TEST(RoadColorTest, IsUnknownBeforeLearning) {
  RoadColor color{RoadColorOptions()};
  EXPECT_FALSE(color.isKnown(1));
  color.learn({gray(100.0)}, kStart);
  EXPECT_FALSE(color.isKnown(1)) << "one pixel is no road";
}

TEST(RoadColorTest, SunAndShadeAreRoadAndColorsBetweenThemAreNot) {
  RoadColor color{RoadColorOptions()};
  color.learn(samplesAround({60.0, 160.0}), kStart);
  EXPECT_GT(color.probability(gray(60.0)), 0.7);
  EXPECT_GT(color.probability(gray(160.0)), 0.7);
  EXPECT_LT(color.probability(gray(110.0)), 0.2);
  EXPECT_LT(color.probability(gray(250.0)), 0.05);
  EXPECT_GT(color.probability(gray(250.0)), 0.04) << "a speck on the road";
}

TEST(RoadColorTest, OneGaussianTakesColorsBetweenThemForRoad) {
  RoadColorOptions thesis;
  thesis.components = 1;
  RoadColor color{thesis};
  color.learn(samplesAround({60.0, 160.0}), kStart);
  EXPECT_LT(color.distance(gray(110.0)), 0.5);
  EXPECT_NEAR(color.distance(gray(160.0)), 50.0 / std::hypot(50.0, kSigma), 0.1);
}

TEST(RoadColorTest, ANewColorIsLearnedFromImageToImage) {
  RoadColor color{RoadColorOptions()};
  color.learn(samplesAround({60.0}), kStart);
  const PixelColors shade = samplesAround({60.0, 160.0});
  color.learn(shade, kStart + 0.1);
  EXPECT_LT(color.probability(gray(160.0)), 0.7) << "not from one image";
  for (int image = 0; image < 60; ++image) {
    color.learn(shade, kStart + 0.2 + 0.1 * image);
  }
  EXPECT_GT(color.probability(gray(160.0)), 0.7);
  EXPECT_GT(color.probability(gray(60.0)), 0.7);
}

TEST(RoadColorTest, LearnsBySecondsWhateverTheRateOfTheImages) {
  std::vector<double> shares;
  for (const double period : {1.0 / 30.0, 0.1, 0.3}) {
    RoadColorOptions options;
    options.components = 1;
    RoadColor color{options};
    color.learn(samplesAround({60.0}), kStart);
    for (int image = 1; image * period < 0.601; ++image) {
      color.learn(samplesAround({160.0}), kStart + image * period);
    }
    shares.push_back(color.distance(gray(60.0)));
  }
  EXPECT_NEAR(shares[0], shares[1], 0.02);
  EXPECT_NEAR(shares[2], shares[1], 0.02);
}

TEST(RoadColorTest, ColorsOfOneBrightnessAreDistinguished) {
  PixelColors samples;
  for (const PixelColor& sample : samplesAround({100.0})) {
    samples.push_back(bgr(sample[0], sample[0], sample[0]));
  }
  RoadColor color{RoadColorOptions()};
  color.learn(samples, kStart);
  ASSERT_TRUE(color.isKnown(3));
  EXPECT_FALSE(color.isKnown(1));
  EXPECT_GT(color.probability(bgr(100.0, 100.0, 100.0)), 0.9);
  EXPECT_LT(color.probability(bgr(60.0, 100.0, 140.0)), 0.1);
}

TEST(RoadColorTest, ImagesOfOneLevelDoNotBreakIt) {
  RoadColor color{RoadColorOptions()};
  color.learn(PixelColors(kSamples, gray(255.0)), kStart);
  EXPECT_GT(color.probability(gray(255.0)), 0.9);
  color.learn(PixelColors(kSamples, gray(0.0)), kStart + 0.1);
  EXPECT_TRUE(std::isfinite(color.probability(gray(0.0))));
  color.reset();
  EXPECT_FALSE(color.isKnown(1));
}

}  // namespace
}  // namespace datmo::road_color_test
