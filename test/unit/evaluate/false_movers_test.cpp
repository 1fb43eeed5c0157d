// SPDX-License-Identifier: BSD-3-Clause
#include "evaluate/false_movers.h"

#include "made_frames.h"
#include <gtest/gtest.h>

namespace datmo::evaluation::false_movers_test {
namespace {

constexpr double kMinSpeed = 0.5;  // m/s

FalseMovers count(const Frames& frames) {
  return countFalseMovers(frames, matchFrames(frames, MatchOptions()), kMinSpeed);
}

TrackState fastTrackAt(std::uint32_t id, double x) {
  TrackState track = trackAt(id, x);
  track.velocity = Point2(0.0, 0.6);
  return track;
}

TEST(FalseMovers, NothingThere) { EXPECT_FALSE(count({}).perFrame()); }

TEST(FalseMovers, AreFastAndFarFromEveryObject) {
  TrackState slow = trackAt(3, 50.0);
  slow.velocity = Point2(0.4, 0.0);
  const FalseMovers movers =
      count(FrameMaker()
                .add({truthAt(1, 0.0)}, {fastTrackAt(1, 0.0), fastTrackAt(2, 20.0), slow})
                .add({truthAt(1, 0.0)}, {fastTrackAt(2, 20.0), fastTrackAt(4, 30.0)})
                .add({}, {})
                .frames());
  EXPECT_EQ(movers.tracks, 3U);
  EXPECT_DOUBLE_EQ(*movers.perFrame(), 1.0);
}

TEST(FalseMovers, SecondTracksOfAnObjectAndTracksOfOptionalOnesAreNone) {
  const FalseMovers movers =
      count(FrameMaker()
                .add({truthAt(1, 0.0), optionalAt(2, 20.0)},
                     {fastTrackAt(1, 0.0), fastTrackAt(2, 1.0), fastTrackAt(3, 20.0)})
                .frames());
  EXPECT_EQ(movers.tracks, 0U);
}

}  // namespace
}  // namespace datmo::evaluation::false_movers_test
