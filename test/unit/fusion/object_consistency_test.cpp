// SPDX-License-Identifier: BSD-3-Clause
// How well the covariances of fused objects match the errors.
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "fusion_objects.h"
#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <gtest/gtest.h>

#include "datmo_fusion/common/random.h"
#include "datmo_fusion/fusion/object/object_combination.h"
#include "datmo_fusion/fusion/object/position_covariance.h"

namespace datmo::object_consistency_test {
namespace {

/// An unbiased measurement of a car by a sensor that sees some of its sides.
Object measured(const Box2& truth, const Eigen::Matrix2d& covariance,
                const std::array<double, kBoxSides>& side_variance, Random& random) {
  Object object;
  object.position_covariance = covariance;
  object.side_variance = side_variance;
  object.heading_variance = 0.001;
  std::array<double, kBoxSides> reach{0.5 * truth.length, 0.5 * truth.length, 0.5 * truth.width,
                                      0.5 * truth.width};
  for (std::size_t side = 0; side < kBoxSides; ++side) {
    reach[side] += std::isfinite(side_variance[side])
                       ? random.normal(std::sqrt(side_variance[side]))
                       : -0.3 * reach[side];
  }
  const Eigen::Matrix2d root = covariance.llt().matrixL();
  const Point2 shift = root * Point2(random.normal(1.0), random.normal(1.0));
  const Point2 middle(0.5 * (reach[0] - reach[1]), 0.5 * (reach[2] - reach[3]));
  object.box = {Pose2(truth.center * middle + shift, truth.center.heading()), reach[0] + reach[1],
                reach[2] + reach[3]};
  return object;
}

/// The front left corner, whose two sides must be visible.
double squaredError(const Object& fused, const Box2& truth) {
  const Eigen::Matrix2d to_box = fused.box.center.rotation().transpose();
  Eigen::Matrix2d covariance = to_box * fused.position_covariance * to_box.transpose();
  covariance(0, 0) += fused.side_variance[sideIndex(BoxSide::kFront)];
  covariance(1, 1) += fused.side_variance[sideIndex(BoxSide::kLeft)];
  const Point2 error = to_box * (fused.box.corners()[0] - truth.corners()[0]);
  return error.dot(covariance.inverse() * error);
}

/// A pair of sensors' measurements of a car.
struct SidesCase {
  std::string name;
  std::array<double, kBoxSides> of_lidar;
  std::array<double, kBoxSides> of_stereo;
  double min_mean;  ///< of the squared error: covariances are conservative if fewer sides are in
                    ///< common
};

TEST(ObjectConsistencyTest, CovariancesAreConsistent) {
  constexpr int kRuns = 5000;
  // Mean of 5000 values of chi-square with two degrees of freedom: 2 +- 3.3 * 2 / sqrt(5000).
  constexpr double kBound = 0.094;
  const double hidden = kHiddenSide;
  const std::vector<SidesCase> cases = {
      {"all sides", {0.01, 0.01, 0.01, 0.01}, {0.04, 0.04, 0.04, 0.04}, 2.0 - kBound},
      {"near sides", {0.001, hidden, 0.001, hidden}, {0.04, hidden, 0.04, hidden}, 2.0 - kBound},
      {"one sees more", {0.001, hidden, 0.04, hidden}, {0.04, 0.04, 0.04, 0.04}, 2.0 - kBound},
      {"a side each", {0.01, hidden, hidden, hidden}, {hidden, hidden, 0.04, hidden}, 2.0 - kBound},
      {"corner and end", {0.01, hidden, 0.01, hidden}, {hidden, 0.04, 0.04, 0.04}, 1.5}};
  const Box2 truth{Pose2(18.0, 6.0, 0.4), 4.4, 1.8};
  const Eigen::Matrix2d of_lidar = Eigen::Matrix2d::Identity() * 0.0025;
  const Eigen::Matrix2d of_stereo = rangeBearingCovariance({18.0, 6.0}, 0.5, 4e-5);
  for (const SidesCase& one : cases) {
    Random random(7);
    double sum = 0.0;
    for (int i = 0; i < kRuns; ++i) {
      const Object lidar = measured(truth, of_lidar, one.of_lidar, random);
      const Object stereo = measured(truth, of_stereo, one.of_stereo, random);
      sum += squaredError(combined(lidar, stereo), truth);
    }
    EXPECT_GT(sum / kRuns, one.min_mean) << one.name;
    EXPECT_LT(sum / kRuns, 2.0 + kBound) << one.name;
  }
}

}  // namespace
}  // namespace datmo::object_consistency_test
