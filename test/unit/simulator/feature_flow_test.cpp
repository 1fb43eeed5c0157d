// SPDX-License-Identifier: BSD-3-Clause
#include "simulator/feature_flow.h"

#include <algorithm>
#include <iterator>

#include "made_worlds.h"
#include <gtest/gtest.h>

namespace datmo::simulator::feature_flow_test {
namespace {

constexpr double kInterval = 1.0 / 12.0;  // s
constexpr std::uint64_t kSeed = 3;

/// A street between walls, with a moving object.
World streetWith(const std::string& kind, const Pose2& start, double speed, double ego_speed) {
  World world(RoadNetwork(), egoAlongX(ego_speed));
  for (const double side : {-8.0, 8.0}) {
    for (double x = 0.0; x < 80.0; x += 6.0) {
      world.addSolid({Box2{{x, side, 0.0}, 5.0, 1.0}, 4.0, Surface::kBody, kNoObject});
    }
  }
  const Point2 end = start * Point2(100.0, 0.0);
  world.addMover(
      {objectKind(kind), Path({start.position(), end}, 0.0), SpeedProfile({{0.0, speed}}), 0.0});
  return world;
}

/// Returns the points above the road within 1.5 m of a position, or beyond.
std::vector<PointVelocity> pointsNear(const std::vector<PointVelocity>& points,
                                      const Point2& position, bool near) {
  std::vector<PointVelocity> result;
  std::copy_if(points.begin(), points.end(), std::back_inserter(result),
               [&](const PointVelocity& point) {
                 const bool is_near = (point.position.head<2>() - position).norm() < 1.5;
                 return point.position.z() > 0.3 && is_near == near;
               });
  return result;
}

TEST(FeatureFlow, TheFirstExposureHasNoPoints) {
  const World world = streetWith("pedestrian", Pose2(12.0, 0.0, 0.5 * kPi), 1.4, 8.0);
  FeatureFlow flow(StereoCameraOptions(), kSeed);
  EXPECT_TRUE(flow.measure(world, 0.0).empty());
  EXPECT_GT(flow.measure(world, kInterval).size(), 100U);
}

TEST(FeatureFlow, VelocitiesAreConsistentWhileTheVehicleDrives) {
  const World world = streetWith("pedestrian", Pose2(12.0, -1.0, 0.5 * kPi), 1.4, 8.0);
  StereoCameraOptions options;
  options.wrong_feature_share = 0.0;
  FeatureFlow flow(options, kSeed);
  flow.measure(world, 0.0);
  double nees = 0.0;
  int standing = 0;
  for (int i = 1; i < 6; ++i) {
    const double time = i * kInterval;
    const WorldState state = world.at(time);
    const Point2 walker = state.base.inverse() * state.objects.back().center.position();
    for (const PointVelocity& point : pointsNear(flow.measure(world, time), walker, false)) {
      const Eigen::Matrix2d covariance =
          (point.covariance + point.common_covariance).topLeftCorner<2, 2>();
      const Eigen::Vector2d velocity = point.velocity.head<2>();
      nees += velocity.dot(covariance.inverse() * velocity);
      ++standing;
    }
  }
  ASSERT_GT(standing, 200);
  EXPECT_GT(nees / standing, 1.0) << "2 degrees of freedom";
  EXPECT_LT(nees / standing, 3.0);
}

TEST(FeatureFlow, AWalkerShowsItsVelocity) {
  const World world = streetWith("pedestrian", Pose2(10.0, -1.0, 0.5 * kPi), 1.4, 5.0);
  FeatureFlow flow(StereoCameraOptions(), kSeed);
  flow.measure(world, 0.0);
  std::vector<PointVelocity> on_walker;
  for (int i = 1; i < 10; ++i) {
    const double time = i * kInterval;
    const WorldState state = world.at(time);
    const Point2 walker = state.base.inverse() * state.objects.back().center.position();
    const auto points = pointsNear(flow.measure(world, time), walker, true);
    on_walker.insert(on_walker.end(), points.begin(), points.end());
  }
  const auto shared =
      sharedVelocity(on_walker, {{10.0, 0.0}, Eigen::Matrix2d::Zero()}, SharedVelocityOptions());
  ASSERT_TRUE(shared);
  EXPECT_NEAR(shared->velocity.y(), 1.4, 0.3);
  EXPECT_NEAR(shared->velocity.x(), 0.0, 0.8);
}

TEST(FeatureFlow, SameSeedSamePoints) {
  const World world = streetWith("car", Pose2(15.0, 0.0, 0.0), 5.0, 8.0);
  FeatureFlow first(StereoCameraOptions(), kSeed);
  FeatureFlow second(StereoCameraOptions(), kSeed);
  for (const double time : {0.0, kInterval}) {
    const auto a = first.measure(world, time);
    const auto b = second.measure(world, time);
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
      EXPECT_EQ(a[i].velocity, b[i].velocity);
    }
  }
}

}  // namespace
}  // namespace datmo::simulator::feature_flow_test
