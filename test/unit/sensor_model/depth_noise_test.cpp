// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/sensor_model/depth_noise.h"

#include <gtest/gtest.h>

namespace datmo::depth_noise_test {
namespace {

DepthNoise noiseOf(DepthPrinciple principle) {
  DepthNoiseOptions options;
  options.principle = principle;
  return depthNoise(options, 400.0, 0.5);
}

TEST(DepthNoise, OfDisparitiesGrowsWithTheSquareOfTheDepth) {
  for (const DepthPrinciple principle : {DepthPrinciple::kStereo, DepthPrinciple::kActiveStereo}) {
    const DepthNoise noise = noiseOf(principle);
    EXPECT_DOUBLE_EQ(noise.sigma(10.0), 0.125) << "100 m^2 * 0.25 px / (400 px * 0.5 m)";
    EXPECT_DOUBLE_EQ(noise.sigma(20.0), 0.5);
    EXPECT_DOUBLE_EQ(noise.inverseSigma(0.1), 0.00125);
  }
}

TEST(DepthNoise, OfDisparitiesIsTheSameNumberAsTheFormula) {
  const double focal_length = 721.5377;
  const double baseline = 0.5371;
  const double sigma = 0.37;
  const DepthNoise noise = DepthNoise::ofDisparity(focal_length, baseline, sigma);
  const InverseDepthMargin margin(noise, 1.7);
  for (double depth = 0.3; depth < 80.0; depth *= 1.13) {
    EXPECT_EQ(noise.sigma(depth), depth * depth * sigma / (focal_length * baseline));
    EXPECT_EQ(noise.inverseSigma(1.0 / depth), sigma / (focal_length * baseline));
    EXPECT_EQ(margin.at(static_cast<float>(1.0 / depth)),
              static_cast<float>(1.7 * (sigma / (focal_length * baseline))));
  }
}

TEST(DepthNoise, OfStructuredLightIsThatOfTheKinect) {
  const DepthNoise noise = noiseOf(DepthPrinciple::kStructuredLight);
  EXPECT_NEAR(noise.sigma(0.4), 0.0012, 1e-9);
  EXPECT_NEAR(noise.sigma(2.4), 0.0088, 1e-9) << "0.0012 + 0.0019 * 2^2 (Nguyen et al. 2012)";
  DepthNoiseOptions options;
  options.principle = DepthPrinciple::kStructuredLight;
  options.structured_light = {0.0, 0.001425, 0.0};
  EXPECT_NEAR(depthNoise(options, 0.0, 0.0).sigma(5.0), 0.035625, 1e-9)
      << "4 cm at 5 m (Khoshelham and Elberink 2012)";
}

TEST(DepthNoise, OfATimeOfFlightIsAConstantAndAShare) {
  const DepthNoise noise = noiseOf(DepthPrinciple::kTimeOfFlight);
  EXPECT_NEAR(noise.sigma(0.0), 0.02, 1e-9);
  EXPECT_NEAR(noise.sigma(3.0), 0.023, 1e-9);
  EXPECT_NEAR(noise.inverseSigma(0.5), 0.0055, 1e-9) << "0.022 m at 2 m: 0.022 / 2^2";
}

TEST(DepthNoise, InverseDepthsAreAsGoodAsDepths) {
  for (const DepthPrinciple principle :
       {DepthPrinciple::kStereo, DepthPrinciple::kStructuredLight, DepthPrinciple::kTimeOfFlight}) {
    const DepthNoise noise = noiseOf(principle);
    const InverseDepthMargin margin(noise, 2.0);
    for (const double depth : {0.5, 1.0, 3.0, 8.0}) {
      const double inverse_sigma = noise.inverseSigma(1.0 / depth);
      EXPECT_NEAR(inverse_sigma * depth * depth, noise.sigma(depth), 1e-12)
          << static_cast<int>(principle) << depth;
      EXPECT_NEAR(static_cast<double>(margin.at(static_cast<float>(1.0 / depth))),
                  2.0 * inverse_sigma, 1e-6);
    }
  }
}

TEST(DepthNoise, UnknownPrinciplesAreNamed) {
  try {
    readOptions<DepthNoiseOptions>({{"depth_noise", std::string("kinect")}});
    FAIL();
  } catch (const OptionError& error) {
    EXPECT_NE(std::string(error.what()).find("'kinect'"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("time_of_flight"), std::string::npos);
  }
}

}  // namespace
}  // namespace datmo::depth_noise_test
