// SPDX-License-Identifier: BSD-3-Clause
// Boxes that drive past a simulated scanner, from its beams to the tracked center: is the center
// consistent with its covariance, and is a part that comes into view not taken for motion?

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "ray_cast.h"
#include <Eigen/LU>
#include <gtest/gtest.h>

#include "datmo_fusion/detection/moving_object_detector.h"
#include "datmo_fusion/tracking/kalman_filter.h"
#include "datmo_fusion/tracking/tracked_box.h"

namespace datmo::tracked_box_simulation_test {
namespace {

constexpr double kPeriod = 0.1;  ///< s

/// v' P^-1 v
double squaredDistance(const Eigen::Vector2d& v, const Eigen::Matrix2d& covariance) {
  return v.dot(covariance.inverse() * v);
}

/// A tracked box with the simplest possible filter, at constant velocity.
class Follower {
 public:
  Follower(const Object& object, const TrackedBoxOptions& options)
      : options_(options), box_(object, options) {
    const PositionMeasurement measured = box_.measurementOf(object);
    estimate_.mean.head<2>() = measured.position;
    estimate_.covariance.setZero();
    estimate_.covariance.diagonal() << 0.0, 0.0, 64.0, 64.0, 0.25, 0.25;
    estimate_.covariance.topLeftCorner<2, 2>() = measured.covariance;
  }

  void predict() {
    estimate_ = datmo::predict(estimate_, coordinatedTurn(0.0, TargetMotionOptions(), kPeriod));
    box_.predict(kPeriod, options_);
    since_update_ += kPeriod;
  }

  void update(const Object& object) {
    estimate_ = datmo::update(estimate_, box_.measurementOf(object));
    shift(box_.update(object, since_update_, options_));
    since_update_ = 0.0;
    ++objects_;
    constexpr double kSignificant = 9.0;
    if (velocity().norm() > 0.8 &&
        squaredDistance(velocity(), velocityCovariance()) > kSignificant) {
      shift(box_.followVelocity(velocity(), velocityCovariance(), options_));
    }
  }

  int objects() const { return objects_; }
  const TrackedBox& box() const { return box_; }
  Point2 center() const { return estimate_.mean.head<2>(); }
  Eigen::Vector2d velocity() const { return estimate_.mean.segment<2>(2); }
  Eigen::Matrix2d velocityCovariance() const { return estimate_.covariance.block<2, 2>(2, 2); }
  Eigen::Matrix2d centerCovariance() const {
    return estimate_.covariance.topLeftCorner<2, 2>() + box_.centerCovariance();
  }

 private:
  void shift(const Point2& offset) { estimate_.mean.head<2>() += offset; }

  TrackedBoxOptions options_;
  TrackedBox box_;
  StateEstimate estimate_;
  double since_update_ = 0.0;
  int objects_ = 1;
};

/// Returns the scanner's measurement of a box, if that is one object; nothing if it is out of view
/// or in pieces.
std::optional<Object> objectOf(const Box2& box, const std::vector<Box2>& others,
                               const RayCaster& scanner, Random& random) {
  // The fit to a few noisy points has a larger error than their mean.
  constexpr double kFitShare = 0.75;
  constexpr double kNearest = 2.0;  // m; nearer than that it would be run over
  if (box.distanceTo(Point2::Zero()) < kNearest) {
    return std::nullopt;
  }
  MovingObjectDetectorOptions options;
  options.range_sigma = scanner.range_sigma;
  options.position_sigma = kFitShare * scanner.range_sigma;
  std::vector<Box2> boxes = others;
  boxes.push_back(box);
  std::optional<Object> found;
  const MovingObjectDetector detector(options);
  for (const Object& object : detector.detect(scanner.scan(boxes, random)).objects) {
    const double tolerance = 0.05 + 4.0 * scanner.range_sigma;
    if (box.distanceTo(object.points.front()) < tolerance &&
        box.distanceTo(object.points.back()) < tolerance) {
      if (found) {
        return std::nullopt;
      }
      found = object;
    }
  }
  return found;
}

struct Traffic {
  double length;  ///< m
  double width;   ///< m
  double speed;   ///< m/s
};

/// Means over one instant of each of many drives.
struct Consistency {
  double position = 0.0;  ///< NEES of the center, 2 degrees of freedom
  double velocity = 0.0;  ///< NEES of its velocity
  double length_error = 0.0;
  int drives = 0;
  int turned_round = 0;  ///< the front is taken for the rear
};

/// Straight drives in random directions past the scanner, evaluated at one random instant of each,
/// so that the samples are independent.
Consistency consistencyOf(const Traffic& traffic, const RayCaster& scanner) {
  constexpr int kDrives = 200;
  constexpr int kScans = 50;
  Consistency result;
  for (int drive = 0; drive < kDrives; ++drive) {
    Random random(static_cast<std::uint64_t>(drive) + 1);
    const Pose2 middle(random.uniform(8.0, 25.0), random.uniform(-8.0, 8.0),
                       random.uniform(-kPi, kPi));
    const int instant = static_cast<int>(random.uniform(10.0, kScans));
    std::optional<Follower> follower;
    for (int scan = 0; scan <= instant; ++scan) {
      const double distance = traffic.speed * kPeriod * (scan - kScans / 2);
      const Box2 truth{middle * Pose2(distance, 0.0, 0.0), traffic.length, traffic.width};
      if (follower) {
        follower->predict();
      }
      const auto object = objectOf(truth, {}, scanner, random);
      if (object && follower) {
        follower->update(*object);
      } else if (object) {
        follower.emplace(*object, TrackedBoxOptions());
      }
      if (scan == instant && follower && object && follower->objects() > 5) {
        const Eigen::Vector2d velocity = truth.center.rotate(Eigen::Vector2d(traffic.speed, 0.0));
        result.position += squaredDistance(follower->center() - truth.center.position(),
                                           follower->centerCovariance());
        result.velocity +=
            squaredDistance(follower->velocity() - velocity, follower->velocityCovariance());
        const Box2 box = follower->box().at(follower->center());
        result.length_error += std::abs(box.length - traffic.length);
        result.turned_round +=
            follower->box().signKnown() && std::cos(box.center.heading() - middle.heading()) < 0.0;
        ++result.drives;
      }
    }
  }
  result.position /= result.drives;
  result.velocity /= result.drives;
  result.length_error /= result.drives;
  return result;
}

/// The mean of n samples with 2 degrees of freedom is below this with 97.5 %: the upper end of the
/// two-sided 95 % interval (normal approximation of chi-square with 2 n degrees of freedom).
double upperBound(int samples) { return 2.0 + 1.96 * 2.0 / std::sqrt(samples); }

class TrackedBoxDrives : public testing::TestWithParam<Traffic> {};

TEST_P(TrackedBoxDrives, TheCenterIsWithinItsCovariance) {
  const RayCaster fine(degrees(180.0), degrees(0.5), 0.05);
  const RayCaster coarse(degrees(180.0), degrees(2.0), 0.2);
  for (const RayCaster& scanner : {fine, coarse}) {
    const Consistency found = consistencyOf(GetParam(), scanner);
    const std::string which = std::to_string(scanner.range_sigma) + " m of noise";
    EXPECT_GT(found.drives, 90) << which;
    EXPECT_LT(found.position, upperBound(found.drives)) << which;
    // Below the interval: these drive straighter than the filter expects, and boxes are rectangles.
    EXPECT_GT(found.position, 0.3) << which;
    EXPECT_LT(found.velocity, upperBound(found.drives)) << which;
    EXPECT_LE(found.turned_round, found.drives / 50) << which;
    EXPECT_LT(found.length_error, 0.15 * GetParam().length + 2.0 * scanner.range_sigma) << which;
    RecordProperty("drives", found.drives);
    RecordProperty("position_nees_percent", static_cast<int>(100.0 * found.position));
    RecordProperty("velocity_nees_percent", static_cast<int>(100.0 * found.velocity));
  }
}

INSTANTIATE_TEST_SUITE_P(Traffic, TrackedBoxDrives,
                         testing::Values(Traffic{4.4, 1.8, 6.0}, Traffic{9.0, 2.5, 6.0},
                                         Traffic{1.8, 0.6, 4.0}, Traffic{0.6, 0.6, 1.4}));

TEST(TrackedBoxSimulation, ACarThatComesFromBehindAWallDoesNotJump) {
  // It drives to the left at 12 m; a wall at 8 m hides everything to the right of x = 0.
  constexpr double kSpeed = 3.0;
  const Box2 wall{Pose2(8.0, -4.0, 0.0), 0.3, 8.0};
  const RayCaster scanner(degrees(180.0), degrees(0.5), 0.03);
  double velocity_nees = 0.0;
  double mean_error = 0.0;
  int samples = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Random random(seed);
    std::optional<Follower> follower;
    double longest = 0.0;
    for (int scan = 0; scan < 40; ++scan) {
      const Box2 car{Pose2(12.0, -3.0 + kSpeed * kPeriod * scan, 0.5 * kPi), 4.4, 1.8};
      if (follower) {
        follower->predict();
      }
      const auto object = objectOf(car, {wall}, scanner, random);
      if (!object) {
        continue;
      }
      if (!follower) {
        follower.emplace(*object, TrackedBoxOptions());
        continue;
      }
      follower->update(*object);
      const Box2 box = follower->box().at(follower->center());
      longest = std::max(longest, std::max(box.length, box.width));
      if (follower->objects() > 8) {
        const Eigen::Vector2d error = follower->velocity() - Eigen::Vector2d(0.0, kSpeed);
        velocity_nees += squaredDistance(error, follower->velocityCovariance());
        mean_error += error.y();
        ++samples;
      }
    }
    EXPECT_LT(longest, 5.0) << "no longer than what is usual, and what was seen";
    ASSERT_TRUE(follower);
    EXPECT_NEAR(std::max(follower->box().at(Point2::Zero()).length,
                         follower->box().at(Point2::Zero()).width),
                4.4, 0.15);
  }
  EXPECT_GT(samples, 300);
  EXPECT_LT(velocity_nees / samples, 2.0);
  EXPECT_NEAR(mean_error / samples, 0.0, 0.05 * kSpeed);
}

}  // namespace
}  // namespace datmo::tracked_box_simulation_test
