// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/vision/quad_matcher.h"

#include <stdexcept>

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

namespace datmo::quad_matcher_test {
namespace {

constexpr int kWidth = 320;
constexpr int kHeight = 200;
constexpr double kDisparity = 6.0;  // px

/// A cloudy texture, seen `right` px further right and `down` px lower.
cv::Mat texture(double right, double down) {
  cv::RNG random(7);
  cv::Mat image(kHeight + 100, kWidth + 100, CV_8UC1);
  random.fill(image, cv::RNG::UNIFORM, 0, 256);
  cv::GaussianBlur(image, image, cv::Size(), 2.0);
  cv::normalize(image, image, 0, 255, cv::NORM_MINMAX);
  cv::Mat result;
  const cv::Mat shift = (cv::Mat_<double>(2, 3) << 1.0, 0.0, right - 50.0, 0.0, 1.0, down - 50.0);
  cv::warpAffine(image, result, shift, cv::Size(kWidth, kHeight), cv::INTER_LINEAR);
  return result;
}

TEST(QuadMatcher, FindsFlowAndDisparityOfATexture) {
  QuadMatcher matcher{QuadMatcherOptions()};
  EXPECT_TRUE(matcher.match(texture(0.0, 0.0), texture(-kDisparity, 0.0)).empty()) << "the first";
  const auto quads = matcher.match(texture(3.5, 1.25), texture(3.5 - kDisparity, 1.25));
  ASSERT_GT(quads.size(), 100U);
  int good = 0;
  for (const auto& [earlier, later] : quads) {
    const Eigen::Vector2d error = later.pixel - earlier.pixel - Eigen::Vector2d(3.5, 1.25);
    good += error.norm() < 0.2 && std::abs(later.disparity - kDisparity) < 0.2 &&
                    std::abs(earlier.disparity - kDisparity) < 0.2
                ? 1
                : 0;
  }
  EXPECT_GT(good, 0.95 * static_cast<double>(quads.size()));
}

TEST(QuadMatcher, FeaturesInOneImageOnlyAreNoQuad) {
  QuadMatcher matcher{QuadMatcherOptions()};
  matcher.match(texture(0.0, 0.0), texture(-kDisparity, 0.0));
  cv::Mat other;
  cv::flip(texture(0.0, 0.0), other, -1);
  EXPECT_LT(matcher.match(other, texture(-kDisparity, 0.0)).size(), 20U);
}

TEST(QuadMatcher, StartsOverAfterAResetAndWithAnotherSize) {
  QuadMatcher matcher{QuadMatcherOptions()};
  const cv::Mat left = texture(0.0, 0.0);
  const cv::Mat right = texture(-kDisparity, 0.0);
  matcher.match(left, right);
  EXPECT_FALSE(matcher.match(left, right).empty());
  matcher.reset();
  EXPECT_TRUE(matcher.match(left, right).empty());
  const cv::Rect part(0, 0, kWidth / 2, kHeight);
  EXPECT_TRUE(matcher.match(left(part).clone(), right(part).clone()).empty());
}

TEST(QuadMatcher, ABlackImageHasNoFeatures) {
  QuadMatcher matcher{QuadMatcherOptions()};
  const cv::Mat black = cv::Mat::zeros(kHeight, kWidth, CV_8UC1);
  EXPECT_TRUE(matcher.match(black, black).empty());
  EXPECT_TRUE(matcher.match(black, black).empty());
}

TEST(QuadMatcher, RefusesImagesThatAreNotAPair) {
  QuadMatcher matcher{QuadMatcherOptions()};
  const cv::Mat gray = texture(0.0, 0.0);
  cv::Mat color;
  cv::cvtColor(gray, color, cv::COLOR_GRAY2BGR);
  EXPECT_THROW(matcher.match(gray, color), std::invalid_argument);
  EXPECT_THROW(matcher.match(cv::Mat(), cv::Mat()), std::invalid_argument);
  EXPECT_THROW(matcher.match(gray, gray.rowRange(0, 10)), std::invalid_argument);
}

}  // namespace
}  // namespace datmo::quad_matcher_test
