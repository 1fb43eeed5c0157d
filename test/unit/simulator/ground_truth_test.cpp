// SPDX-License-Identifier: BSD-3-Clause
#include "simulator/ground_truth.h"

#include "made_worlds.h"
#include <gtest/gtest.h>

namespace datmo::simulator::ground_truth_test {
namespace {

const Viewpoint kView{"scanner", Pose2(), 0.45, degrees(160.0), 50.0};

LineOfSight lookAtFirst(const World& world) {
  const WorldState state = world.at(0.0);
  return lookAt(state.objects.at(0), kView, world, state);
}

World worldWithCar(const Pose2& center) {
  World world = emptyWorld();
  world.addStanding(objectKind("car"), center);
  return world;
}

TEST(LookAt, FreeObjectIsVisible) {
  const LineOfSight line_of_sight = lookAtFirst(worldWithCar({20.0, 0.0, kPi / 2.0}));
  EXPECT_DOUBLE_EQ(line_of_sight.hidden, 0.0);
  EXPECT_DOUBLE_EQ(line_of_sight.visible, 1.0);
}

TEST(LookAt, WallHidesAllOrHalf) {
  World hidden = worldWithCar({20.0, 0.0, kPi / 2.0});
  hidden.addSolid(wallAt(10.0));
  EXPECT_DOUBLE_EQ(lookAtFirst(hidden).hidden, 1.0);
  EXPECT_DOUBLE_EQ(lookAtFirst(hidden).visible, 0.0);
  World half = worldWithCar({20.0, 0.0, kPi / 2.0});
  half.addSolid({Segment{{10.0, 0.0}, {10.0, 50.0}}, 3.0, Surface::kBody, kNoObject});
  EXPECT_NEAR(lookAtFirst(half).hidden, 0.5, 0.03);
  EXPECT_NEAR(lookAtFirst(half).visible, 0.5, 0.03);
}

TEST(LookAt, LowObjectsAndObjectsBehindHideNothing) {
  World world = worldWithCar({20.0, 0.0, kPi / 2.0});
  world.addSolid(wallAt(10.0, 0.3));
  world.addSolid({Segment{{11.0, -9.0}, {11.0, 9.0}}, 0.12, Surface::kCurb, kNoObject});
  world.addSolid(wallAt(30.0));
  EXPECT_DOUBLE_EQ(lookAtFirst(world).hidden, 0.0);
}

TEST(LookAt, FieldOfViewAndRangeEndVisibilityButAreNoOcclusion) {
  for (const Pose2& center : {Pose2(-20.0, 0.0, 0.0), Pose2(55.0, 0.0, 0.0)}) {
    const LineOfSight line_of_sight = lookAtFirst(worldWithCar(center));
    EXPECT_DOUBLE_EQ(line_of_sight.hidden, 0.0);
    EXPECT_DOUBLE_EQ(line_of_sight.visible, 0.0);
  }
}

TEST(ObjectTruths, CountsTheBeamsThatEndOnTheObject) {
  // A car across the view at 20 m is 4.4 / 19.1 rad = 13 deg wide: beams at -6, -4, ... 6 deg.
  World world = worldWithCar({20.0, 0.0, kPi / 2.0});
  world.addSolid(wallAt(10.0, 0.1));
  LaserScanner scanner(idealScanner(), RandomStream(1, "scanner"));
  const auto truths = objectTruths(world, world.at(0.0), scanner.measure(world, 0.0),
                                   {scanner.viewpoint()}, GroundTruthOptions());
  ASSERT_EQ(truths.size(), 1U);
  EXPECT_EQ(truths[0].lidar_beams, 7);
  EXPECT_EQ(truths[0].visible_to, std::vector<std::string>{"scanner"});
  EXPECT_FALSE(truths[0].state.moving);
}

TEST(ObjectTruths, NamesEachSensorThatSeesEnough) {
  World world = worldWithCar({20.0, 0.0, kPi / 2.0});
  Viewpoint backward = kView;
  backward.sensor = "rear";
  backward.sensor_in_base = Pose2(0.0, 0.0, kPi);
  Viewpoint camera = kView;
  camera.sensor = "camera";
  const auto truths =
      objectTruths(world, world.at(0.0), {}, {kView, backward, camera}, GroundTruthOptions());
  EXPECT_EQ(truths.at(0).visible_to, (std::vector<std::string>{"scanner", "camera"}));
}

TEST(ObjectTruths, LeavesOutDistantObjects) {
  GroundTruthOptions options;
  options.radius = 30.0;
  World world = worldWithCar({31.0, 0.0, 0.0});
  EXPECT_TRUE(objectTruths(world, world.at(0.0), {}, {kView}, options).empty());
}

TEST(World, MoverTurnsAboutItsRearAxle) {
  // Arc of radius 10 m at 5 m/s: yaw rate 0.5 rad/s, and the middle 1.35 m ahead of the axle moves
  // to the left as well.
  World world = emptyWorld();
  world.addMover({objectKind("car"), Path({{0.0, 0.0}, {20.0, 0.0}, {20.0, 20.0}}, 10.0),
                  SpeedProfile({{0.0, 5.0}}), 10.0});
  const WorldState now = world.at(1.0);
  const WorldState later = world.at(1.0 + 1e-5);
  const ObjectState& object = now.objects.at(0);
  EXPECT_TRUE(object.moving);
  EXPECT_NEAR(object.velocity.norm(), std::sqrt(25.0 + 0.675 * 0.675), 1e-9);
  const Point2 difference =
      (later.objects.at(0).center.position() - object.center.position()) / 1e-5;
  EXPECT_NEAR((difference - object.velocity).norm(), 0.0, 1e-3);
}

}  // namespace
}  // namespace datmo::simulator::ground_truth_test
