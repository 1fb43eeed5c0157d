// SPDX-License-Identifier: BSD-3-Clause
#include "evaluate/standing_objects.h"

#include "evaluate/made_frames.h"
#include "evaluate/made_recordings.h"
#include <gtest/gtest.h>

namespace datmo::evaluation::standing_objects_test {
namespace {

const Stamp kStart = Stamp::fromSeconds(0.0);

RecordedObject parkedAt(std::uint32_t id, double x, double y) {
  RecordedObject parked = carAt(id, x, y);
  parked.moving = false;
  parked.state.velocity = Point2::Zero();
  return parked;
}

/// Tracks at 0 s, between a car that drives at (10, 0) and parked ones, 4 m x 2 m, at (10, 6) and
/// (15, 6). Another one is parked outside the region, and there is a pole beside the road.
std::vector<StandingObject> scoreOf(const std::vector<TrackState>& tracks) {
  RecordedObject pole = parkedAt(5, 10.0, -6.0);
  pole.state.classification = ObjectClass::kPole;
  const RecordedTruth truth{{{kStart,
                              {carAt(1, 10.0), parkedAt(2, 10.0, 6.0), parkedAt(3, 15.0, 6.0),
                               parkedAt(4, 80.0, 6.0), pole}}},
                            standingVehicle(),
                            std::nullopt};
  const TrueScene scene(truth, {});
  const Frames frames{{kStart, scene.at(kStart)->objects, tracks}};
  const MatchOptions options;
  return scoreStandingObjects(frames, matchFrames(frames, options), scene, options);
}

TEST(ScoreStandingObjects, HoldsThoseThatCouldBeMistakenForMovers) {
  const auto objects = scoreOf({});
  ASSERT_EQ(objects.size(), 2U);
  EXPECT_EQ(objects[0].id, 2U);
  EXPECT_EQ(objects[0].classification, ObjectClass::kVehicle);
  EXPECT_EQ(objects[0].frames, 1U);
  EXPECT_EQ(objects[0].tracked_frames, 0U);
  EXPECT_EQ(objects[1].id, 3U);
}

TEST(ScoreStandingObjects, AFalseTrackIsOnTheNearestOne) {
  const auto objects = scoreOf({trackAt(7, 13.2, 6.0)});  // 1.2 m from the one, 0.2 m inside of
  EXPECT_EQ(objects.at(0).tracked_frames, 0U);            // the other
  EXPECT_EQ(objects.at(1).tracked_frames, 1U);
}

TEST(ScoreStandingObjects, ATrackOfAMoverIsOnNoParkedCar) {
  const auto objects = scoreOf({trackAt(7, 10.0, 3.0)});  // 2 m from each car's side
  EXPECT_EQ(objects.at(0).tracked_frames, 0U);
}

TEST(ScoreStandingObjects, ATrackBeyondTheGateIsOnNone) {
  const auto objects = scoreOf({trackAt(7, 10.0, 9.1)});
  EXPECT_EQ(objects.at(0).tracked_frames, 0U);
  EXPECT_EQ(scoreOf({trackAt(7, 10.0, 8.9)}).at(0).tracked_frames, 1U);
}

}  // namespace
}  // namespace datmo::evaluation::standing_objects_test
