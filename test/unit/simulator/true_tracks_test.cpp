// SPDX-License-Identifier: BSD-3-Clause
#include "simulator/true_tracks.h"

#include <gtest/gtest.h>

#include "datmo_fusion/tracking/track_check.h"

namespace datmo::simulator::true_tracks_test {
namespace {

/// The host drives at 10 m/s along x; a car ahead of it brakes at 2 m/s^2 from 1 s on.
World braking() {
  World world(RoadNetwork(),
              {objectKind("car"), Path({{0, 0}, {200, 0}}, 0.0), SpeedProfile({{0.0, 10.0}}), 0.0});
  world.addMover({objectKind("car"), Path({{30, 0}, {200, 0}}, 0.0),
                  SpeedProfile({{1.0, 10.0}, {6.0, 0.0}}), 0.0});
  world.addStanding(objectKind("van"), Pose2(20.0, 8.0, 0.0));
  return world;
}

std::vector<ObjectTruth> truthsAt(const World& world, double time, bool visible = true) {
  std::vector<ObjectTruth> truths;
  for (const ObjectState& object : world.at(time).objects) {
    ObjectTruth truth;
    truth.state = object;
    if (visible) {
      truth.visible_to = {"lidar"};
    }
    truths.push_back(truth);
  }
  return truths;
}

TEST(IdealTracker, KnowsStateAndModeOfMovingObjects) {
  const World world = braking();
  IdealTracker tracker(world);
  const TruePerception perception = tracker.at(3.0, truthsAt(world, 3.0));
  ASSERT_EQ(perception.tracks.size(), 1U);
  const Track& track = perception.tracks[0];
  EXPECT_TRUE(isValid(track));
  EXPECT_NEAR(track.state[2], 6.0, 1e-6);
  EXPECT_NEAR(track.state[4], -2.0, 1e-6);
  EXPECT_EQ(track.mode_probabilities[static_cast<std::size_t>(MotionMode::kConstantAcceleration)],
            0.9);
}

TEST(IdealTracker, StationaryObjectsArePoints) {
  const World world = braking();
  IdealTracker tracker(world);
  const TruePerception perception = tracker.at(0.0, truthsAt(world, 0.0));
  ASSERT_FALSE(perception.standing.empty());
  for (const Point2& point : perception.standing) {
    EXPECT_NEAR(point.y(), 8.0, 1.0 + 1e-9);
  }
}

TEST(IdealTracker, KeepsObjectsThatHaveMovedAndHaveBeenSeen) {
  const World world = braking();
  IdealTracker tracker(world);
  EXPECT_TRUE(tracker.at(0.0, truthsAt(world, 0.0, false)).tracks.empty());
  EXPECT_EQ(tracker.at(1.0, truthsAt(world, 1.0)).tracks.size(), 1U);
  const auto stopped = tracker.at(8.0, truthsAt(world, 8.0, false)).tracks;
  ASSERT_EQ(stopped.size(), 1U);
  EXPECT_FALSE(stopped[0].moving);
}

TEST(TrueHost, HasTheAccelerationOfTheLastHalfSecond) {
  World world(RoadNetwork(), {objectKind("car"), Path({{0, 0}, {200, 0}}, 0.0),
                              SpeedProfile({{1.0, 10.0}, {3.0, 6.0}}), 0.0});
  const HostState host = trueHost(world, 2.0, HostVehicleOptions());
  EXPECT_NEAR(host.speed, 8.0, 1e-9);
  EXPECT_NEAR(host.acceleration, -2.0, 1e-9);
  EXPECT_EQ(trueHost(world, 0.0, HostVehicleOptions()).acceleration, 0.0);
}

}  // namespace
}  // namespace datmo::simulator::true_tracks_test
