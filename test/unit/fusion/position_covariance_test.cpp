// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/fusion/object/position_covariance.h"

#include <string>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "datmo_fusion/common/angle.h"

namespace datmo::position_covariance_test {
namespace {

PositionCovarianceOptions table() {
  PositionCovarianceOptions options;
  options.bin_width = 2.0;
  options.range_variance = {0.01, 0.04, 0.09};
  options.bearing_variance = {0.001, 0.002, 0.003};
  return options;
}

TEST(PositionCovarianceTest, RangeIsAlongTheLineOfSightAndBearingAcrossIt) {
  const Eigen::Matrix2d ahead = rangeBearingCovariance({10.0, 0.0}, 0.25, 0.0004);
  EXPECT_NEAR(ahead(0, 0), 0.25, 1e-12);
  EXPECT_NEAR(ahead(1, 1), 0.04, 1e-12);
  EXPECT_NEAR(ahead(0, 1), 0.0, 1e-12);
  const Eigen::Matrix2d left = rangeBearingCovariance({0.0, 10.0}, 0.25, 0.0004);
  EXPECT_NEAR(left(0, 0), 0.04, 1e-12);
  EXPECT_NEAR(left(1, 1), 0.25, 1e-12);
  // Half left: a quarter of the difference on either side of their mean.
  const Eigen::Matrix2d slant = rangeBearingCovariance({6.0, 8.0}, 0.25, 0.0004);
  EXPECT_NEAR(slant(0, 0), 0.36 * 0.25 + 0.64 * 0.04, 1e-12);
  EXPECT_NEAR(slant(0, 1), 0.48 * (0.25 - 0.04), 1e-12);
}

TEST(PositionCovarianceTest, TheBinIsThatOfTheRangeFromTheSensor) {
  const PositionCovarianceOptions options = table();
  const Point2 sensor(1.0, 0.0);
  EXPECT_NEAR(options.at({2.9, 0.0}, sensor)(0, 0), 0.01, 1e-12);
  EXPECT_NEAR(options.at({3.1, 0.0}, sensor)(0, 0), 0.04, 1e-12);
  EXPECT_NEAR(options.at({3.1, 0.0}, sensor)(1, 1), 0.002 * 2.1 * 2.1, 1e-12);
}

TEST(PositionCovarianceTest, BeyondTheLastBinItsVariancesApply) {
  const Eigen::Matrix2d far = table().at({100.0, 0.0}, Point2::Zero());
  EXPECT_NEAR(far(0, 0), 0.09, 1e-12);
  EXPECT_NEAR(far(1, 1), 0.003 * 1e4, 1e-9);
}

TEST(PositionCovarianceTest, AtTheSensorItIsPositiveDefinite) {
  const Eigen::Matrix2d here = table().at(Point2::Zero(), Point2::Zero());
  EXPECT_GT(here.determinant(), 0.0);
}

TEST(PositionCovarianceTest, ListsOfDifferentLengthAreRefusedByName) {
  PositionCovarianceOptions options = table();
  options.check("stereo");
  options.bearing_variance.pop_back();
  try {
    options.check("stereo");
    FAIL() << "expected an OptionError";
  } catch (const OptionError& error) {
    EXPECT_EQ(std::string(error.what()),
              "stereo/bearing_variance has 2 numbers: expected as many as range_variance has, 3");
  }
}

TEST(PositionCovarianceTest, VariancesOfZeroAreRefused) {
  PositionCovarianceOptions options = table();
  checkOptions(options);
  options.range_variance[1] = 0.0;
  EXPECT_THROW(checkOptions(options), OptionError);
}

}  // namespace
}  // namespace datmo::position_covariance_test
