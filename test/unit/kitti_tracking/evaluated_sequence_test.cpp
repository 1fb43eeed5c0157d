// SPDX-License-Identifier: BSD-3-Clause
#include "kitti_tracking/evaluated_sequence.h"

#include "made_rows.h"
#include <gtest/gtest.h>

namespace datmo::kitti::evaluated_sequence_test {
namespace {

EvaluatedSequence evaluated(const std::vector<TrackedObject>& labels,
                            const std::vector<TrackedObject>& results,
                            ObjectType type = ObjectType::kCar) {
  return evaluatedSequence({"0000", labels, results}, {type, 0.25});
}

bool isRequired(const TrackedObject& label, ObjectType type = ObjectType::kCar) {
  return evaluated({label}, {}, type).frames.at(label.frame).truths.at(0).required;
}

bool isOptional(const TrackedObject& result, const std::vector<TrackedObject>& labels = {}) {
  return evaluated(labels, {result}).frames.at(result.frame).tracks.at(0).optional;
}

TEST(EvaluatedSequence, OtherClassesAreIgnored) {
  const EvaluatedSequence sequence = evaluated({rowAt(0, 1, 0.0, ObjectType::kTruck)},
                                               {rowAt(0, 1, 0.0, ObjectType::kPedestrian)});
  EXPECT_TRUE(sequence.frames.empty());
  EXPECT_EQ(sequence.truths, 0U);
  EXPECT_TRUE(sequence.scores.empty());
  const TrackedObject person = rowAt(0, 1, 0.0, ObjectType::kPerson);
  EXPECT_EQ(evaluated({person}, {}, ObjectType::kPedestrian).truths, 0U);
}

TEST(EvaluatedSequence, NeighborsNeedNotBeFound) {
  EXPECT_TRUE(isRequired(rowAt(0, 1, 0.0)));
  EXPECT_FALSE(isRequired(rowAt(0, 1, 0.0, ObjectType::kVan)));
  EXPECT_TRUE(isRequired(rowAt(0, 1, 0.0, ObjectType::kPedestrian), ObjectType::kPedestrian));
  EXPECT_FALSE(isRequired(rowAt(0, 1, 0.0, ObjectType::kPersonSitting), ObjectType::kPedestrian));
}

TEST(EvaluatedSequence, LargelyOccludedMustBeFoundUnknownNeedNot) {
  TrackedObject label = rowAt(0, 1, 0.0);
  label.occluded = 2;
  EXPECT_TRUE(isRequired(label));
  label.occluded = 3;
  EXPECT_FALSE(isRequired(label));
}

TEST(EvaluatedSequence, TruncatedNeedNotBeFound) {
  TrackedObject label = rowAt(0, 1, 0.0);
  label.truncated = 1;
  EXPECT_FALSE(isRequired(label));
}

TEST(EvaluatedSequence, SmallImagesAreNoFalsePositives) {
  TrackedObject result = resultAt(0, 1, 0.0);
  result.image_box.bottom = result.image_box.top + 25.0;
  EXPECT_TRUE(isOptional(result));
  result.image_box.bottom += 0.1;
  EXPECT_FALSE(isOptional(result));
}

TEST(EvaluatedSequence, MoreThanHalfWhereNobodyCaresIsNoFalsePositive) {
  const TrackedObject result = resultAt(0, 1, 0.0);  // image from 100 to 200 px
  EXPECT_TRUE(isOptional(result, {dontCare(0, {0.0, 0.0, 151.0, 300.0})}));
  EXPECT_FALSE(isOptional(result, {dontCare(0, {0.0, 0.0, 150.0, 300.0})}));
  EXPECT_FALSE(isOptional(result, {dontCare(1, {0.0, 0.0, 151.0, 300.0})}));
}

TEST(EvaluatedSequence, CandidatesOverlapEnough) {
  const EvaluatedSequence sequence =
      evaluated({rowAt(0, 1, 0.0)}, {resultAt(0, 1, 0.5), resultAt(0, 2, 0.7)});
  const std::vector<Candidate>& candidates = sequence.frames.at(0).candidates;
  ASSERT_EQ(candidates.size(), 1U);
  EXPECT_EQ(candidates[0].track, 0U);
  EXPECT_NEAR(candidates[0].overlap, 1.0 / 3.0, 1e-12);
}

TEST(EvaluatedSequence, ScoresAreMeansOfTheRows) {
  const EvaluatedSequence sequence = evaluated(
      {}, {resultAt(0, 7, 0.0, 1.0), resultAt(1, 7, 0.0, 4.0), resultAt(1, 3, 5.0, -2.0)});
  ASSERT_EQ(sequence.scores.size(), 2U);
  EXPECT_DOUBLE_EQ(sequence.scores[0], 2.5);
  EXPECT_DOUBLE_EQ(sequence.scores[1], -2.0);
  EXPECT_EQ(sequence.rows, (std::vector<std::size_t>{2, 1}));
}

TEST(EvaluatedSequence, RowsOfFilesInAnyOrder) {
  const EvaluatedSequence sequence =
      evaluated({rowAt(1, 1, 0.0), rowAt(0, 1, 0.0)}, {resultAt(1, 1, 0.0), resultAt(0, 1, 0.0)});
  EXPECT_EQ(sequence.frames.size(), 2U);
  EXPECT_EQ(sequence.truths, 1U);
  EXPECT_EQ(sequence.scores.size(), 1U);
}

}  // namespace
}  // namespace datmo::kitti::evaluated_sequence_test
