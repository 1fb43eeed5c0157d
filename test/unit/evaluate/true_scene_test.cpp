// SPDX-License-Identifier: BSD-3-Clause
#include "evaluate/true_scene.h"

#include "evaluate/made_recordings.h"
#include <gtest/gtest.h>

namespace datmo::evaluation::true_scene_test {
namespace {

const Stamp kEarlier = Stamp::fromSeconds(1.0);
const Stamp kLater = Stamp::fromSeconds(1.2);

/// A stationary vehicle and its surroundings at 1.0 s and 1.2 s.
RecordedTruth truthOf(const std::vector<RecordedObject>& earlier,
                      const std::vector<RecordedObject>& later) {
  return {{{kEarlier, earlier}, {kLater, later}}, standingVehicle(), std::nullopt};
}

std::vector<TrueState> objectsAt(const RecordedTruth& truth, double seconds,
                                 const ScoreOptions& options = {}) {
  const auto view = TrueScene(truth, options).at(Stamp::fromSeconds(seconds));
  return view ? view->objects : std::vector<TrueState>();
}

/// Returns whether a car, changed like this, has to be found.
bool isRequired(const RecordedObject& object, const ScoreOptions& options = {}) {
  const auto objects = objectsAt(truthOf({object}, {object}), 1.0, options);
  return objects.size() == 1 && objects.front().duty == Duty::kRequired;
}

TEST(TrueScene, ObjectsAreInterpolatedBetweenTheirNeighbors) {
  RecordedObject later = carAt(1, 12.0, 1.0);
  later.state.velocity = Point2(20.0, 4.0);
  const auto objects = objectsAt(truthOf({carAt(1, 10.0)}, {later}), 1.05);
  ASSERT_EQ(objects.size(), 1U);
  EXPECT_NEAR(objects[0].box.center.x(), 10.5, 1e-9);
  EXPECT_NEAR(objects[0].box.center.y(), 0.25, 1e-9);
  EXPECT_NEAR(objects[0].velocity.x(), 12.5, 1e-9);
  EXPECT_NEAR(objects[0].velocity.y(), 1.0, 1e-9);
}

TEST(TrueScene, HeadingsAreInterpolatedTheShorterWayRound) {
  RecordedObject earlier = carAt(1, 10.0);
  RecordedObject later = earlier;
  earlier.state.box.center = Pose2(10.0, 0.0, 3.0);
  later.state.box.center = Pose2(10.0, 0.0, -3.0);
  const auto objects = objectsAt(truthOf({earlier}, {later}), 1.1);
  EXPECT_NEAR(std::abs(objects.at(0).box.center.heading()), kPi, 1e-9);
}

TEST(TrueScene, AnObjectInOneNeighborIsExtrapolated) {
  const auto ends = objectsAt(truthOf({carAt(1, 10.0)}, {}), 1.1);
  ASSERT_EQ(ends.size(), 1U);
  EXPECT_NEAR(ends[0].box.center.x(), 11.0, 1e-9);
  const auto begins = objectsAt(truthOf({}, {carAt(1, 10.0)}), 1.1);
  ASSERT_EQ(begins.size(), 1U);
  EXPECT_NEAR(begins[0].box.center.x(), 9.0, 1e-9);
}

TEST(TrueScene, IsUnknownOutsideAndInAGap) {
  ScoreOptions options;
  const TrueScene scene(truthOf({carAt(1, 10.0)}, {carAt(1, 12.0)}), options);
  EXPECT_FALSE(scene.at(Stamp::fromSeconds(0.99)));
  EXPECT_FALSE(scene.at(Stamp::fromSeconds(1.21)));
  EXPECT_TRUE(scene.at(Stamp::fromSeconds(1.1)));
  options.max_gap = 0.19;
  EXPECT_FALSE(TrueScene(truthOf({}, {}), options).at(Stamp::fromSeconds(1.1)));
}

TEST(TrueScene, ParkedObjectsAreLeftOutAndStoppedOnesAreOptional) {
  RecordedObject parked = carAt(1, 10.0);
  parked.moving = false;
  RecordedObject waiting = carAt(2, 20.0);
  waiting.moving = false;
  const auto objects = objectsAt(truthOf({parked, waiting}, {parked, carAt(2, 20.0)}), 1.0);
  ASSERT_EQ(objects.size(), 1U);
  EXPECT_EQ(objects[0].id, 2U);
  EXPECT_EQ(objects[0].duty, Duty::kOptional);
}

TEST(TrueScene, TheRegionIsAboutTheVehicle) {
  ScoreOptions options;
  options.region = {50.0, degrees(40.0)};
  EXPECT_TRUE(isRequired(carAt(1, 49.9), options));
  EXPECT_FALSE(isRequired(carAt(1, 50.1), options));
  EXPECT_TRUE(isRequired(carAt(1, 10.0, 8.3), options));   // 39.7 degrees
  EXPECT_FALSE(isRequired(carAt(1, 10.0, 8.5), options));  // 40.4 degrees
  EXPECT_FALSE(isRequired(carAt(1, -10.0), options));
}

TEST(TrueScene, SensorsWithAViewAreRequired) {
  RecordedObject car = carAt(1, 10.0);
  ScoreOptions options;
  options.truth.visible_to = "camera";
  EXPECT_FALSE(isRequired(car, options));
  options.truth.visible_to = "scanner";
  EXPECT_TRUE(isRequired(car, options));
  car.visible_to = {};
  EXPECT_FALSE(isRequired(car));
  options.truth.visible_to = "none";
  EXPECT_TRUE(isRequired(car, options));
}

TEST(TrueScene, SpeedAndBeamsAreRequired) {
  ScoreOptions options;
  options.truth.min_speed = 10.1;
  EXPECT_FALSE(isRequired(carAt(1, 10.0), options));
  options.truth.min_speed = 9.9;
  options.truth.min_beams = 4;
  EXPECT_FALSE(isRequired(carAt(1, 10.0), options));
  options.truth.min_beams = 3;
  EXPECT_TRUE(isRequired(carAt(1, 10.0), options));
}

TEST(TrueScene, ClassesAreChosenOneByOne) {
  struct Case {
    ObjectClass classification;
    bool ClassOptions::*toggle;
  };
  for (const Case& c : {Case{ObjectClass::kVehicle, &ClassOptions::vehicle},
                        Case{ObjectClass::kCyclist, &ClassOptions::cyclist},
                        Case{ObjectClass::kPedestrian, &ClassOptions::pedestrian},
                        Case{ObjectClass::kUnknown, &ClassOptions::unknown}}) {
    RecordedObject object = carAt(1, 10.0);
    object.state.classification = c.classification;
    EXPECT_TRUE(isRequired(object));
    ScoreOptions options;
    options.truth.classes.*c.toggle = false;
    EXPECT_FALSE(isRequired(object, options));
  }
}

}  // namespace
}  // namespace datmo::evaluation::true_scene_test
