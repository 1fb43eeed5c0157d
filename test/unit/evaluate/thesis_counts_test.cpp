// SPDX-License-Identifier: BSD-3-Clause
#include "evaluate/thesis_counts.h"

#include "made_frames.h"
#include <gtest/gtest.h>

namespace datmo::evaluation::thesis_counts_test {
namespace {

ThesisCounts count(const Frames& frames) {
  return countAsThesis(frames, matchFrames(frames, MatchOptions()));
}

/// Track 1 is on an object in the first `hits` frames, and far from it in the others.
Frames trackThatLeaves(int hits, int others) {
  FrameMaker maker;
  for (int i = 0; i < hits + others; ++i) {
    maker.add({truthAt(1, 0.0)}, {trackAt(1, i < hits ? 0.0 : 50.0)});
  }
  return maker.frames();
}

TEST(ThesisCounts, NothingThere) {
  const ThesisCounts counts = count({});
  EXPECT_EQ(counts.moving_objects + counts.missed_objects + counts.tracks + counts.false_tracks,
            0U);
}

TEST(ThesisCounts, MissedObjectsAreThoseNeverMatched) {
  const ThesisCounts counts =
      count(FrameMaker()
                .add({truthAt(1, 0.0), truthAt(2, 9.0)}, {})
                .add({truthAt(1, 0.0), truthAt(2, 9.0), optionalAt(3, 20.0)}, {trackAt(1, 0.0)})
                .frames());
  EXPECT_EQ(counts.moving_objects, 2U);
  EXPECT_EQ(counts.missed_objects, 1U);
}

TEST(ThesisCounts, FalseTracksAreFalseInMoreThanHalfOfTheirFrames) {
  EXPECT_EQ(count(trackThatLeaves(2, 2)).false_tracks, 0U);
  EXPECT_EQ(count(trackThatLeaves(2, 3)).false_tracks, 1U);
  EXPECT_EQ(count(trackThatLeaves(2, 3)).tracks, 1U);
}

TEST(ThesisCounts, NeutralFramesCountInFavorOfATrack) {
  const ThesisCounts counts = count(FrameMaker()
                                        .add({optionalAt(1, 0.0)}, {trackAt(1, 0.0)})
                                        .add({optionalAt(1, 0.0)}, {trackAt(1, 50.0)})
                                        .frames());
  EXPECT_EQ(counts.tracks, 1U);
  EXPECT_EQ(counts.false_tracks, 0U);
}

TEST(ThesisCounts, TracksOfOptionalObjectsAloneAreNotCounted) {
  EXPECT_EQ(count(FrameMaker().add({optionalAt(1, 0.0)}, {trackAt(1, 0.0)}).frames()).tracks, 0U);
}

TEST(ThesisCounts, ConfirmedTracksAndThoseOfThemThatAreTrue) {
  // Track 1 is confirmed once, and true; 2 is confirmed and false; 3 is true, of one sensor.
  TrackState confirmed_true = trackAt(1, 0.0);
  TrackState confirmed_false = trackAt(2, 50.0);
  confirmed_true.sensors = 2;
  confirmed_false.sensors = 3;
  const std::vector<TrueState> truths{truthAt(1, 0.0), truthAt(2, 9.0)};
  const ThesisCounts counts =
      count(FrameMaker()
                .add(truths, {confirmed_true, confirmed_false, trackAt(3, 9.0)})
                .add(truths, {trackAt(1, 0.0), trackAt(2, 50.0), trackAt(3, 9.0)})
                .frames());
  EXPECT_EQ(counts.tracks, 3U);
  EXPECT_EQ(counts.false_tracks, 1U);
  EXPECT_EQ(counts.confirmed_tracks, 2U);
  EXPECT_EQ(counts.confirmed_true_tracks, 1U);
}

}  // namespace
}  // namespace datmo::evaluation::thesis_counts_test
