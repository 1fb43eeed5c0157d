// SPDX-License-Identifier: BSD-3-Clause
#include "evaluate/object_scores.h"

#include "made_frames.h"
#include <gtest/gtest.h>

namespace datmo::evaluation::object_scores_test {
namespace {

std::vector<ObjectScore> score(const Frames& frames) {
  return scoreObjects(frames, matchFrames(frames, MatchOptions()));
}

TEST(ObjectScores, NoObjects) {
  EXPECT_TRUE(score({}).empty());
  EXPECT_TRUE(score(FrameMaker().add({optionalAt(1, 0.0)}, {trackAt(1, 0.0)}).frames()).empty());
}

TEST(ObjectScores, AMissedObject) {
  const std::vector<ObjectScore> objects = score(followedBy({0, 0}));
  ASSERT_EQ(objects.size(), 1U);
  EXPECT_FALSE(objects[0].found());
  EXPECT_FALSE(objects[0].delay);
  EXPECT_DOUBLE_EQ(objects[0].completeness(), 0.0);
  EXPECT_TRUE(objects[0].track_ids.empty());
  EXPECT_FALSE(objects[0].errors.position);
}

TEST(ObjectScores, AnObjectFromFirstToLast) {
  // Required from second 1 to 6, found after two seconds, by two tracks.
  FrameMaker maker;
  maker.add({optionalAt(5, 0.0)}, {trackAt(8, 0.0)});
  TrueState cyclist = truthAt(5, 0.0);
  cyclist.classification = ObjectClass::kCyclist;
  for (const std::uint32_t track : {0U, 0U, 3U, 2U, 3U, 0U}) {
    maker.add({cyclist}, track == 0U ? std::vector<TrackState>()
                                     : std::vector<TrackState>{trackAt(track, 1.0)});
  }
  maker.add({optionalAt(5, 0.0)}, {});
  const std::vector<ObjectScore> objects = score(maker.frames());
  ASSERT_EQ(objects.size(), 1U);
  EXPECT_EQ(objects[0].id, 5U);
  EXPECT_EQ(objects[0].classification, ObjectClass::kCyclist);
  EXPECT_EQ(objects[0].first, Stamp::fromSeconds(1.0));
  EXPECT_EQ(objects[0].last, Stamp::fromSeconds(6.0));
  EXPECT_EQ(objects[0].required_frames, 6U);
  EXPECT_EQ(objects[0].tracked_frames, 3U);
  EXPECT_TRUE(objects[0].found());
  EXPECT_DOUBLE_EQ(objects[0].delay.value(), 2.0);
  EXPECT_DOUBLE_EQ(objects[0].completeness(), 0.5);
  EXPECT_EQ(objects[0].track_ids, (std::vector<std::uint32_t>{3U, 2U}));
  EXPECT_DOUBLE_EQ(objects[0].errors.position.value(), 1.0);
}

TEST(ObjectScores, ByFirstFrameEachWithItsOwnErrors) {
  const std::vector<ObjectScore> objects =
      score(FrameMaker()
                .add({truthAt(9, 0.0)}, {trackAt(1, 0.0)})
                .add({truthAt(4, 20.0), truthAt(9, 0.0)}, {trackAt(2, 20.5), trackAt(1, 0.0)})
                .frames());
  ASSERT_EQ(objects.size(), 2U);
  EXPECT_EQ(objects[0].id, 9U);
  EXPECT_EQ(objects[1].id, 4U);
  EXPECT_DOUBLE_EQ(objects[0].errors.position.value(), 0.0);
  EXPECT_DOUBLE_EQ(objects[1].errors.position.value(), 0.5);
  EXPECT_DOUBLE_EQ(objects[1].delay.value(), 0.0);
}

TEST(ObjectScores, DelaysAreOfFoundObjects) {
  EXPECT_FALSE(scoreDelays({}).mean);
  std::vector<ObjectScore> objects(4);
  objects[0].delay = 0.5;
  objects[1].delay = 0.1;
  objects[3].delay = 3.0;
  const DelayScore score = scoreDelays(objects);
  EXPECT_EQ(score.objects, 3U);
  EXPECT_DOUBLE_EQ(*score.mean, 1.2);
  EXPECT_DOUBLE_EQ(*score.median, 0.5);
}

}  // namespace
}  // namespace datmo::evaluation::object_scores_test
