// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/detection/radar_object_detector.h"

#include <cmath>
#include <random>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "datmo_fusion/common/angle.h"
#include "datmo_fusion/common/square.h"

namespace datmo {
namespace {

/// A radar's measurement of a point without noise.
RadarReturn returnOf(const Point2& position, const Point2& velocity, const Pose2& radar,
                     const Twist2& twist) {
  const Point2 lever = radar.position();
  const Point2 own(twist.forward_speed - twist.yaw_rate * lever.y(), twist.yaw_rate * lever.x());
  const Point2 seen = radar.inverse() * position;
  const Point2 along = (position - lever).normalized();
  return {seen.norm(), std::atan2(seen.y(), seen.x()), (velocity - own).dot(along)};
}

RadarObjects detect(const std::vector<RadarReturn>& returns, const Pose2& radar = Pose2(),
                    const Twist2& twist = {},
                    const RadarObjectDetectorOptions& options = RadarObjectDetectorOptions()) {
  return RadarObjectDetector(options).detect({Stamp(), radar, returns}, twist);
}

TEST(RadarObjects, VelocityAlongTheLineOfSightIsOverTheGround) {
  // 3 m ahead of the origin and 1 m to the left, facing left; the vehicle drives 10 m/s and turns
  // at 0.5 rad/s to the left, so that the radar moves 10 - 0.5 * 1 = 9.5 m/s ahead and 0.5 * 3 =
  // 1.5 m/s to the left. 20 m to its left an object approaches at 4.5 m/s: it moves 3 m/s to the
  // right.
  const Pose2 radar(3.0, 1.0, degrees(90.0));
  const RadarObjects found = detect({{20.0, 0.0, -4.5}}, radar, {10.0, 0.5});
  ASSERT_EQ(found.list.objects.size(), 1U);
  const Object& object = found.list.objects[0];
  EXPECT_NEAR(object.box.center.x(), 3.0, 1e-9);
  EXPECT_NEAR(object.box.center.y(), 21.0, 1e-9);
  ASSERT_TRUE(object.velocity);
  EXPECT_NEAR(object.velocity->velocity.x(), 0.0, 1e-9);
  EXPECT_NEAR(object.velocity->velocity.y(), -3.0, 1e-9);
  EXPECT_NEAR(object.velocity->covariance(0, 0), 100.0, 1e-9);
  // By the Doppler shift, and by the bearing due to the lateral motions, 9.5 and 10 m/s; not by the
  // vehicle's own speed, which is lateral.
  EXPECT_NEAR(object.velocity->covariance(1, 1), 0.01 + 1e-4 * (square(9.5) + square(10.0)), 1e-9);
  EXPECT_EQ(object.sensors, std::vector<std::string>{"radar"});
  for (const double variance : object.side_variance) {
    EXPECT_EQ(variance, kHiddenSide);
  }
}

TEST(RadarObjects, PositionIsAsCertainAsRangeAndBearing) {
  RadarObjectDetectorOptions options;
  options.reflection_sigma = 0.0;
  const Object ahead = detect({{50.0, 0.0, 5.0}}, Pose2(), {}, options).list.objects.at(0);
  EXPECT_NEAR(ahead.position_covariance(0, 0), square(0.2), 1e-9);
  EXPECT_NEAR(ahead.position_covariance(1, 1), square(50.0 * 0.01), 1e-9);
  // Ahead, the vehicle's own speed counts, too.
  EXPECT_NEAR(ahead.velocity->covariance(0, 0), 0.01 + 1e-4 * square(10.0) + 0.01, 1e-9);
  // Four returns of it halve the standard deviation of its middle.
  const Object four = detect(std::vector<RadarReturn>(4, {50.0, 0.0, 5.0}), Pose2(), {}, options)
                          .list.objects.at(0);
  EXPECT_NEAR(four.position_covariance(1, 1), square(0.25), 1e-9);
  EXPECT_GT(four.box.length, 0.0);
}

TEST(RadarObjects, StationaryObjectsAreLeftOutAtAnySpeedOfTheVehicle) {
  const Pose2 radar(3.5, -0.5, degrees(-20.0));
  const Twist2 twist{15.0, 0.4};
  std::vector<RadarReturn> returns;
  for (int i = 0; i < 20; ++i) {  // a guard rail
    returns.push_back(returnOf(Point2(10.0 + 3.0 * i, -6.0), Point2(0.0, 0.0), radar, twist));
  }
  returns.push_back(returnOf(Point2(40.0, -6.0), Point2(10.0, 0.0), radar, twist));
  const RadarObjects found = detect(returns, radar, twist);
  ASSERT_EQ(found.list.objects.size(), 1U);
  EXPECT_NEAR(found.list.objects[0].box.center.x(), 40.0, 1e-9);
  EXPECT_GT(found.standing, 0U);
}

TEST(RadarObjects, AreSeparatedByPositionOrSpeed) {
  EXPECT_EQ(detect({{20.0, 0.0, 5.0}, {21.0, 0.0, 5.2}}).list.objects.size(), 1U);
  EXPECT_EQ(detect({{20.0, 0.0, 5.0}, {24.0, 0.0, 5.0}}).list.objects.size(), 2U);
  EXPECT_EQ(detect({{20.0, 0.0, 5.0}, {20.5, 0.0, 9.0}}).list.objects.size(), 2U);
  // One leads to the next.
  EXPECT_EQ(detect({{20.0, 0.0, 5.0}, {21.5, 0.0, 5.0}, {23.0, 0.0, 5.0}}).list.objects.size(), 1U);
  // At 150 m the bearing's noise alone is 1.5 m.
  EXPECT_EQ(detect({{150.0, -0.015, 5.0}, {150.0, 0.015, 5.0}}).list.objects.size(), 1U);
}

TEST(RadarObjects, RequireEnoughReturns) {
  RadarObjectDetectorOptions options;
  options.min_returns = 3;
  const std::vector<RadarReturn> returns{
      {20.0, 0.0, 5.0}, {21.0, 0.0, 5.0}, {22.0, 0.0, 5.0}, {40.0, 0.0, 5.0}, {41.0, 0.0, 5.0}};
  const RadarObjects found = detect(returns, Pose2(), {}, options);
  ASSERT_EQ(found.list.objects.size(), 1U);
  EXPECT_NEAR(found.list.objects[0].box.center.x(), 21.0, 1e-9);
  EXPECT_EQ(found.unclustered, 2U);
  EXPECT_TRUE(detect({}).list.objects.empty());
}

TEST(RadarObjects, HaveConsistentCovariances) {
  // A curve, with a radar at a front corner: objects of known position and velocity, whose
  // reflections lie anywhere on them; noise as in the options.
  constexpr int kCycles = 2000;
  const RadarObjectDetectorOptions options;
  const Pose2 radar(3.6, 0.8, degrees(30.0));
  std::mt19937 random(11);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> share(0.0, 1.0);
  double position_sum = 0.0;
  double speed_sum = 0.0;
  int count = 0;
  for (int cycle = 0; cycle < kCycles; ++cycle) {
    const Twist2 twist{20.0 * share(random), 0.5 * normal(random)};
    const double bearing = 2.0 * (share(random) - 0.5);
    const Point2 middle = radar * Point2(60.0 * (0.2 + share(random)), 0.0);
    const Point2 truth = radar.position() + Pose2(0, 0, bearing).rotate(middle - radar.position());
    const Point2 velocity = options.tangential_sigma * Point2(normal(random), normal(random));
    const Point2 reflection =
        truth + options.reflection_sigma * Point2(normal(random), normal(random));
    std::vector<RadarReturn> returns;
    for (int i = 0; i <= cycle % 4; ++i) {
      RadarReturn one = returnOf(reflection, velocity, radar, twist);
      one.range += options.range_sigma * normal(random);
      one.bearing += options.bearing_sigma * normal(random);
      one.range_rate += options.range_rate_sigma * normal(random);
      returns.push_back(one);
    }
    const Twist2 measured{twist.forward_speed + options.own_speed_sigma * normal(random),
                          twist.yaw_rate};
    const RadarObjects found = detect(returns, radar, measured);
    if (found.list.objects.size() != 1) {
      continue;  // it hardly moves along the line of sight, or falls apart
    }
    const Object& object = found.list.objects[0];
    const Point2 off = object.box.center.position() - truth;
    position_sum += off.dot(object.position_covariance.inverse() * off);
    const Point2 along = (object.box.center.position() - radar.position()).normalized();
    const double speed_off = (object.velocity->velocity - velocity).dot(along);
    speed_sum += square(speed_off) / along.dot(object.velocity->covariance * along);
    ++count;
  }
  ASSERT_GT(count, kCycles * 3 / 4);
  RecordProperty("nees_position", std::to_string(position_sum / count));
  RecordProperty("nees_speed", std::to_string(speed_sum / count));
  // Two degrees of freedom, and one.
  EXPECT_GT(position_sum / count, 1.8);
  EXPECT_LT(position_sum / count, 2.2);
  EXPECT_GT(speed_sum / count, 0.8);
  EXPECT_LT(speed_sum / count, 1.3);
}

}  // namespace
}  // namespace datmo
