// SPDX-License-Identifier: BSD-3-Clause
#include "evaluate/gospa.h"

#include <cmath>
#include <random>

#include "made_frames.h"
#include <gtest/gtest.h>

namespace datmo::evaluation::gospa_test {
namespace {

using Points = std::vector<Point2>;

const GospaOptions kCutoff4{4.0};

Points randomPoints(std::mt19937_64& engine) {
  std::uniform_int_distribution<int> number(0, 5);
  std::uniform_real_distribution<double> coordinate(0.0, 10.0);
  Points points(static_cast<std::size_t>(number(engine)));
  for (Point2& point : points) {
    point = Point2(coordinate(engine), coordinate(engine));
  }
  return points;
}

TEST(Gospa, EmptySetsAreTheSame) { EXPECT_EQ(gospa({}, {}, kCutoff4).total, 0.0); }

TEST(Gospa, OnePair) {
  const Gospa result = gospa({Point2(0.0, 0.0)}, {Point2(0.0, 3.0)}, kCutoff4);
  EXPECT_DOUBLE_EQ(result.total, 3.0);
  EXPECT_DOUBLE_EQ(result.localization, 3.0);
  EXPECT_EQ(result.missed, 0.0);
  EXPECT_EQ(result.false_tracks, 0.0);
}

TEST(Gospa, AMissAndAFalseTrackCostHalfTheSquareEach) {
  // sqrt(16 / 2).
  const Gospa missed = gospa({Point2(0.0, 0.0)}, {}, kCutoff4);
  EXPECT_DOUBLE_EQ(missed.total, std::sqrt(8.0));
  EXPECT_DOUBLE_EQ(missed.missed, std::sqrt(8.0));
  const Gospa wrong = gospa({}, {Point2(0.0, 0.0), Point2(1.0, 0.0)}, kCutoff4);
  EXPECT_DOUBLE_EQ(wrong.total, std::sqrt(16.0));
  EXPECT_DOUBLE_EQ(wrong.false_tracks, 4.0);
}

TEST(Gospa, PairsBeyondTheCutoffAreMissesAndFalseTracks) {
  const Gospa result = gospa({Point2(0.0, 0.0)}, {Point2(9.0, 0.0)}, kCutoff4);
  EXPECT_DOUBLE_EQ(result.total, 4.0);
  EXPECT_EQ(result.localization, 0.0);
  EXPECT_DOUBLE_EQ(result.missed, std::sqrt(8.0));
  EXPECT_DOUBLE_EQ(result.false_tracks, std::sqrt(8.0));
}

TEST(Gospa, PartsAddUpInSquares) {
  // A pair at 1 m and a miss: sqrt(1 + 16 / 2).
  const Gospa result = gospa({Point2(0.0, 0.0), Point2(50.0, 0.0)}, {Point2(1.0, 0.0)}, kCutoff4);
  EXPECT_DOUBLE_EQ(result.total, 3.0);
  EXPECT_DOUBLE_EQ(result.localization, 1.0);
  EXPECT_DOUBLE_EQ(result.missed, std::sqrt(8.0));
}

TEST(Gospa, TheBestAssignmentIsTaken) {
  // Nearest first would give 0 and 3.5^2 = 12.25; the best assignment has 2^2 + 1.5^2 = 6.25.
  const Gospa result =
      gospa({Point2(0.0, 0.0), Point2(2.0, 0.0)}, {Point2(2.0, 0.0), Point2(3.5, 0.0)}, kCutoff4);
  EXPECT_DOUBLE_EQ(result.total, 2.5);
}

TEST(Gospa, IsAMetric) {
  std::mt19937_64 engine(5);
  for (int run = 0; run < 2000; ++run) {
    const Points a = randomPoints(engine);
    const Points b = randomPoints(engine);
    const Points c = randomPoints(engine);
    const double a_to_b = gospa(a, b, kCutoff4).total;
    EXPECT_EQ(gospa(a, a, kCutoff4).total, 0.0);
    EXPECT_NEAR(a_to_b, gospa(b, a, kCutoff4).total, 1e-12);
    EXPECT_LE(a_to_b, gospa(a, c, kCutoff4).total + gospa(c, b, kCutoff4).total + 1e-12);
    EXPECT_TRUE(a.empty() && b.empty() ? a_to_b == 0.0 : a_to_b > 0.0);
  }
}

TEST(Gospa, AFramesObjectsAndTracksThatCount) {
  // One required object missed; a neutral track; a false one.
  const Frames frames =
      FrameMaker()
          .add({truthAt(1, 0.0), optionalAt(2, 20.0)}, {trackAt(1, 20.0), trackAt(2, 40.0)})
          .frames();
  const std::vector<Gospa> result =
      gospaOfFrames(frames, matchFrames(frames, MatchOptions()), kCutoff4);
  ASSERT_EQ(result.size(), 1U);
  EXPECT_DOUBLE_EQ(result[0].total, 4.0);
  EXPECT_DOUBLE_EQ(result[0].missed, std::sqrt(8.0));
  EXPECT_DOUBLE_EQ(result[0].false_tracks, std::sqrt(8.0));
}

TEST(Gospa, CentersCountWhateverTheGateMeasures) {
  TrueState truck = truthAt(1, 0.0);
  truck.box.length = 8.0;
  const Frames frames = FrameMaker().add({truck}, {trackAt(1, 3.0)}).frames();
  EXPECT_DOUBLE_EQ(gospaOfFrames(frames, matchFrames(frames, MatchOptions()), kCutoff4)[0].total,
                   3.0);
}

TEST(Gospa, MeanOverFrames) {
  EXPECT_FALSE(meanGospa({}));
  const Gospa mean = meanGospa({{5.0, 3.0, 4.0, 0.0}, {2.0, 0.0, 0.0, 2.0}}).value();
  EXPECT_DOUBLE_EQ(mean.total, 3.5);
  EXPECT_DOUBLE_EQ(mean.localization, 1.5);
  EXPECT_DOUBLE_EQ(mean.missed, 2.0);
  EXPECT_DOUBLE_EQ(mean.false_tracks, 1.0);
}

}  // namespace
}  // namespace datmo::evaluation::gospa_test
