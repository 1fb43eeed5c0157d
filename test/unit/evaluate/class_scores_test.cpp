// SPDX-License-Identifier: BSD-3-Clause
#include "evaluate/class_scores.h"

#include "made_frames.h"
#include <gtest/gtest.h>

namespace datmo::evaluation::class_scores_test {
namespace {

ClassScores score(const Frames& frames) {
  return scoreClasses(frames, matchFrames(frames, MatchOptions()));
}

TrueState ofClass(ObjectClass classification, TrueState truth) {
  truth.classification = classification;
  return truth;
}

TrackState ofClass(ObjectClass classification, TrackState track) {
  track.classification = classification;
  return track;
}

TEST(ClassScores, WithoutMatchesThereIsNoShare) {
  EXPECT_FALSE(score({}).all.share());
  EXPECT_FALSE(score(followedBy({0, 0})).all.share());
}

TEST(ClassScores, OnlyRequiredObjectsOfAKnownClassCount) {
  const TrackState car = ofClass(ObjectClass::kVehicle, trackAt(1, 0.0));
  const ClassScores scores =
      score(FrameMaker()
                .add({truthAt(1, 0.0)}, {car})
                .add({ofClass(ObjectClass::kVehicle, optionalAt(1, 0.0))}, {car})
                .add({ofClass(ObjectClass::kVehicle, truthAt(1, 9.0))}, {car})
                .frames());
  EXPECT_EQ(scores.all.frames, 0U);
  EXPECT_TRUE(scores.by_class.empty());
}

TEST(ClassScores, OverallAndByTrueClass) {
  const TrueState car = ofClass(ObjectClass::kVehicle, truthAt(1, 0.0));
  const TrueState walker = ofClass(ObjectClass::kPedestrian, truthAt(2, 9.0));
  const auto carAs = [](ObjectClass said) { return ofClass(said, trackAt(1, 0.0)); };
  const auto walkerAs = [](ObjectClass said) { return ofClass(said, trackAt(2, 9.0)); };
  const ClassScores scores = score(
      FrameMaker()
          .add({car, walker}, {carAs(ObjectClass::kVehicle), walkerAs(ObjectClass::kUnknown)})
          .add({car, walker}, {carAs(ObjectClass::kVehicle), walkerAs(ObjectClass::kPedestrian)})
          .add({car}, {carAs(ObjectClass::kCyclist)})
          .frames());
  EXPECT_EQ(scores.all.frames, 5U);
  EXPECT_DOUBLE_EQ(*scores.all.share(), 0.6);
  EXPECT_EQ(scores.all.silent, 1U);
  EXPECT_DOUBLE_EQ(*scores.by_class.at(ObjectClass::kVehicle).share(), 2.0 / 3.0);
  EXPECT_DOUBLE_EQ(*scores.by_class.at(ObjectClass::kPedestrian).share(), 0.5);
  EXPECT_EQ(scores.by_class.at(ObjectClass::kPedestrian).silent, 1U);
  EXPECT_EQ(scores.by_class.size(), 2U);
}

}  // namespace
}  // namespace datmo::evaluation::class_scores_test
