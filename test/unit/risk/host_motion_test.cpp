// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/risk/host_motion.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "datmo_fusion/common/angle.h"
#include "datmo_fusion/common/twist2.h"
#include "datmo_fusion/risk/host_futures.h"

namespace datmo::host_motion_test {
namespace {

const HostVehicleOptions kVehicle;

BicycleState drive(BicycleState state, const HostCommand& command, double seconds, int steps) {
  for (int i = 0; i < steps; ++i) {
    state = afterStep(state, command, seconds / steps, kVehicle);
  }
  return state;
}

TEST(BicycleModel, GoesStraight) {
  const BicycleState end = drive({bodyPose({1, 2}, 0.0), 10.0, 0.0}, {}, 2.0, 10);
  EXPECT_NEAR(end.rear_axle.center.x(), 21.0, 1e-9);
  EXPECT_NEAR(end.rear_axle.center.y(), 2.0, 1e-9);
}

TEST(BicycleModel, AcceleratesExactly) {
  const BicycleState end = drive({BodyPose(), 10.0, 0.0}, {2.0, 0.0}, 2.0, 1);
  EXPECT_NEAR(end.rear_axle.center.x(), 24.0, 1e-9);
  EXPECT_NEAR(end.speed, 14.0, 1e-12);
}

TEST(BicycleModel, FollowsACircle) {
  const double steering = 0.1;
  const double yaw_rate = 5.0 * std::tan(steering) / kVehicle.wheelbase;
  const BicycleState end = drive({BodyPose(), 5.0, steering}, {}, 4.0, 20);
  const Pose2 circle = arc({5.0, yaw_rate}, 4.0);
  EXPECT_NEAR(end.rear_axle.center.x(), circle.x(), 1e-5);
  EXPECT_NEAR(end.rear_axle.center.y(), circle.y(), 1e-5);
  EXPECT_NEAR(end.rear_axle.heading, circle.heading(), 1e-9);
}

TEST(BicycleModel, ErrorFallsWithTheFourthPowerOfTheStep) {
  const BicycleState start{BodyPose(), 8.0, -0.1};
  const HostCommand command{1.0, 0.1};
  const Point2 exact = drive(start, command, 2.0, 2000).rear_axle.center;
  const double coarse = (drive(start, command, 2.0, 4).rear_axle.center - exact).norm();
  const double fine = (drive(start, command, 2.0, 8).rear_axle.center - exact).norm();
  EXPECT_LT(fine, coarse / 10.0);
  EXPECT_LT(fine, 1e-3);
}

TEST(BicycleModel, BrakesToRestAndStays) {
  const BicycleState end = drive({BodyPose(), 6.0, 0.0}, {-3.0, 0.0}, 4.0, 40);
  EXPECT_EQ(end.speed, 0.0);
  EXPECT_NEAR(end.rear_axle.center.x(), 6.0, 0.01);
  const BicycleState reversing = drive({BodyPose(), -2.0, 0.0}, {1.0, 0.0}, 4.0, 40);
  EXPECT_EQ(reversing.speed, 0.0);
  EXPECT_NEAR(reversing.rear_axle.center.x(), -2.0, 0.01);
}

TEST(BicycleModel, TiresHoldNoSharperTurn) {
  const BicycleState end = drive({BodyPose(), 20.0, 0.5}, {}, 1.0, 10);
  EXPECT_NEAR(end.rear_axle.heading, kVehicle.max_lateral / 20.0, 1e-9);
}

TEST(Steering, IsThatOfTheYawRate) {
  EXPECT_NEAR(steeringOf(5.0, 5.0 * std::tan(0.2) / kVehicle.wheelbase, kVehicle), 0.2, 1e-12);
  EXPECT_NEAR(steeringOf(-5.0, -5.0 * std::tan(0.2) / kVehicle.wheelbase, kVehicle), 0.2, 1e-12);
  EXPECT_EQ(steeringOf(0.1, 0.5, kVehicle), 0.0);
  EXPECT_EQ(steeringOf(1.0, 10.0, kVehicle), kVehicle.max_steering);
}

TEST(Steering, TheFasterTheMoreTheYawRateTells) {
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();
  covariance(1, 1) = 0.02 * 0.02;
  const auto sigma = [&](double speed) {
    return std::sqrt(steeringVariance({speed, 0.0}, covariance, kVehicle));
  };
  EXPECT_NEAR(sigma(10.0), 2.7 / 10.0 * 0.02, 1e-12);
  EXPECT_NEAR(sigma(-2.0), 2.7 / 2.0 * 0.02, 1e-12);
  EXPECT_TRUE(std::isinf(sigma(0.1)));
}

// Against the difference of two angles.
TEST(Steering, TheErrorOfTheSpeedCountsInABend) {
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();
  covariance(0, 0) = 0.01 * 0.01;
  const double change = steeringOf(5.01, 0.5, kVehicle) - steeringOf(5.0, 0.5, kVehicle);
  EXPECT_NEAR(std::sqrt(steeringVariance({5.0, 0.5}, covariance, kVehicle)), std::abs(change),
              1e-6);
}

TEST(Combined, IsWeightedByTheInverseOfTheVariances) {
  EXPECT_NEAR(combined({0.1, 0.03}, {0.5, 0.01}), 0.4, 1e-12);
  EXPECT_EQ(combined({0.1, std::numeric_limits<double>::infinity()}, {0.5, 0.01}), 0.5);
  EXPECT_EQ(combined({0.1, 0.0}, {0.5, 0.01}), 0.1);
}

RoadModel roadAlong(const std::vector<Point2>& points, double probability = 0.9) {
  RoadBorder border;
  border.probability = probability;
  for (const Point2& point : points) {
    border.points.push_back({point, 0.1});
  }
  RoadModel road;
  road.borders.push_back(border);
  return road;
}

TEST(CourseSteering, KeepsBesideABorderThatGoesStraight) {
  HostState host;
  host.speed = 10.0;
  const auto steering = courseSteering(host, roadAlong({{-10, 3}, {40, 3}}), kVehicle, {});
  ASSERT_TRUE(steering);
  EXPECT_NEAR(steering->angle, 0.0, 1e-12);
  EXPECT_GT(steering->probability, 0.98);
  // Two points of 0.1 m (0.02 m more): 2 / 30^2 of 0.1414 m, over the wheelbase.
  EXPECT_NEAR(steering->sigma, kVehicle.wheelbase * 2.0 / 900.0 * std::sqrt(0.0204 / 0.9), 1e-6);
}

TEST(CourseSteering, TurnsWithTheBorder) {
  HostState host;
  host.speed = 10.0;
  // A circle of 50 m radius to the left, with its border 3 m to the right of the host.
  std::vector<Point2> points;
  for (double angle = -0.2; angle < 0.8; angle += 0.02) {
    points.emplace_back(53.0 * std::sin(angle), 50.0 - 53.0 * std::cos(angle));
  }
  const auto steering = courseSteering(host, roadAlong(points), kVehicle, {});
  ASSERT_TRUE(steering);
  EXPECT_NEAR(std::tan(steering->angle) / kVehicle.wheelbase, 1.0 / 50.0, 0.002);
}

// At 5 m/s a driver who keeps the lane sways by 0.3 / (1.2 * 5) = 0.05 rad, and points of 0.1 m, 6
// m apart, tell the direction to 0.024 rad.
TEST(CourseSteering, IsNotOfABorderFromWhichTheVehicleTurnsAway) {
  HostState host;
  host.speed = 5.0;
  const auto probability = [&](double angle) {
    const Point2 along(std::cos(angle), std::sin(angle));
    const Point2 here(0.0, 3.0);
    const auto steering =
        courseSteering(host, roadAlong({here - 10.0 * along, here + 40.0 * along}), kVehicle, {});
    return steering ? steering->probability : 0.0;
  };
  const double variance = 0.05 * 0.05 + 0.0204 / 36.0;
  const double peak = 0.9 / std::sqrt(2.0 * kPi * variance);
  EXPECT_NEAR(probability(0.0), peak / (peak + 0.1 / kPi), 1e-3);
  EXPECT_GT(probability(0.1), 0.95);
  EXPECT_GT(probability(-0.1), 0.95);
  EXPECT_LT(probability(0.3), 0.05);
  EXPECT_LT(probability(-0.3), 0.05);
}

TEST(CourseSteering, IsFollowedInTheSharpestBendOfAStreet) {
  HostState host;
  host.speed = 5.0;
  for (const double radius : {15.0, 30.0}) {
    for (const double aside : {-3.0, 3.0}) {  // m, of the border: inside or outside of a left turn
      std::vector<Point2> points;
      for (double angle = -0.5; angle < 1.3; angle += 0.02) {
        points.emplace_back((radius - aside) * std::sin(angle),
                            radius - (radius - aside) * std::cos(angle));
      }
      const auto steering = courseSteering(host, roadAlong(points), kVehicle, {});
      // Inside of the sharper bend the border ends before it is far enough ahead.
      if (steering) {
        EXPECT_GT(steering->probability, 0.95) << radius << " m, " << aside << " m";
      } else {
        EXPECT_LT(radius - aside, 15.0);
      }
    }
  }
}

TEST(CourseSteering, FollowsTheBorderThatIsKnownBetter) {
  HostState host;
  host.speed = 10.0;
  RoadModel road = roadAlong({{-10, 3}, {40, 3}});
  const auto straight = courseSteering(host, road, kVehicle, {});
  RoadModel vague = roadAlong({{-10, -3}, {40, 2}});
  for (BorderPoint& point : vague.borders.front().points) {
    point.sigma = 1.0;
  }
  road.borders.push_back(vague.borders.front());
  const auto steering = courseSteering(host, road, kVehicle, {});
  const auto by_vague = courseSteering(host, vague, kVehicle, {});
  ASSERT_TRUE(straight && steering && by_vague);
  EXPECT_LT(steering->angle, 0.03 * by_vague->angle);
  EXPECT_LT(steering->sigma, straight->sigma);
  for (BorderPoint& point : vague.borders.front().points) {
    point.sigma = 5.0;
  }
  EXPECT_FALSE(courseSteering(host, vague, kVehicle, {})) << "vaguer than the host's steering";
}

TEST(CourseSteering, IsUnknownWithoutABorderThatIsSure) {
  HostState host;
  host.speed = 10.0;
  EXPECT_FALSE(courseSteering(host, {}, kVehicle, {}));
  EXPECT_FALSE(courseSteering(host, roadAlong({{-10, 3}, {40, 3}}, 0.3), kVehicle, {}));
  EXPECT_FALSE(courseSteering(host, roadAlong({{-10, 3}, {5, 3}}), kVehicle, {}));
  host.speed = -2.0;
  EXPECT_FALSE(courseSteering(host, roadAlong({{-10, 3}, {40, 3}}), kVehicle, {}));
}

}  // namespace
}  // namespace datmo::host_motion_test
