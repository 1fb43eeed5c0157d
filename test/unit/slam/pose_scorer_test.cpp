// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/slam/pose_scorer.h"

#include <limits>

#include "grid/small_map.h"
#include <gtest/gtest.h>

#include "datmo_fusion/common/random.h"

namespace datmo::pose_scorer_test {
namespace {

OccupancyMap smallMap() {
  OccupancyMapOptions options;
  options.window.length = 40.0;
  options.window.width = 40.0;
  return OccupancyMap(options);
}

/// End points of beams in all directions.
std::vector<EndPoint> ends(std::size_t count, Random& random) {
  std::vector<EndPoint> points(count);
  for (EndPoint& point : points) {
    point.position = Point2(random.uniform(-25.0, 25.0), random.uniform(-25.0, 25.0));
  }
  return points;
}

OccupancyMap mapOf(const std::vector<EndPoint>& points) {
  std::vector<Point2> ends;
  for (const EndPoint& point : points) {
    ends.push_back(point.position);
  }
  OccupancyMap map = smallMap();
  for (int i = 0; i < 5; ++i) {
    samples::updateWith(map, samples::scanTo(ends, 0.1 * i));
  }
  return map;
}

std::vector<Pose2> posesAbout(const Pose2& middle, double spread, int count, Random& random) {
  std::vector<Pose2> poses{middle};
  while (static_cast<int>(poses.size()) < count) {
    poses.emplace_back(middle.x() + random.normal(spread), middle.y() + random.normal(spread),
                       middle.heading() + random.normal(0.05 * spread));
  }
  return poses;
}

double meanOccupancy(const OccupancyMap& map, const std::vector<EndPoint>& points,
                     const Pose2& pose) {
  double sum = 0.0;
  for (const EndPoint& point : points) {
    sum += map.occupancy(map.window().cellAt(pose * point.position));
  }
  return sum / static_cast<double>(points.size());
}

/// Returns the first of the best poses, by looking up all end points for all poses.
std::size_t bestByAll(const OccupancyMap& map, const std::vector<EndPoint>& points,
                      const std::vector<Pose2>& poses) {
  std::size_t best = 0;
  for (std::size_t i = 1; i < poses.size(); ++i) {
    if (meanOccupancy(map, points, poses[i]) > meanOccupancy(map, points, poses[best])) {
      best = i;
    }
  }
  return best;
}

TEST(PoseScorer, ScoreIsTheMeanOccupancyWhereBeamsEnd) {
  Random random(1);
  for (const std::size_t count : {1, 15, 16, 17, 81, 200}) {
    const auto points = ends(count, random);
    const OccupancyMap map = mapOf(points);
    const PoseScorer scorer(map, points);
    for (const Pose2& pose : posesAbout(Pose2(), 0.5, 20, random)) {
      EXPECT_EQ(scorer.score(pose), meanOccupancy(map, points, pose));
    }
  }
}

TEST(PoseScorer, BestIsTheOneThatAllLookUpsFind) {
  Random random(2);
  for (const double spread : {0.01, 0.1, 1.0, 10.0}) {
    const auto points = ends(81, random);
    const OccupancyMap map = mapOf(points);
    const auto poses = posesAbout(Pose2(0.3, -0.2, 0.02), spread, 300, random);
    const Pose2 best = PoseScorer(map, points).bestOf(poses);
    const Pose2& expected = poses[bestByAll(map, points, poses)];
    EXPECT_EQ(best.position(), expected.position()) << spread;
    EXPECT_EQ(best.heading(), expected.heading()) << spread;
  }
}

TEST(PoseScorer, OfEqualPosesTheFirstIsBest) {
  Random random(3);
  const auto points = ends(40, random);
  const OccupancyMap map = smallMap();  // all cells are alike
  const auto poses = posesAbout(Pose2(), 1.0, 10, random);
  EXPECT_EQ(PoseScorer(map, points).bestOf(poses).position(), poses.front().position());
}

TEST(PoseScorer, WithoutPointsNothingFits) {
  const OccupancyMap map = smallMap();
  const PoseScorer scorer(map, {});
  EXPECT_EQ(scorer.score(Pose2()), 0.0);
  EXPECT_EQ(scorer.bestOf({Pose2(1.0, 0.0, 0.0), Pose2()}).x(), 1.0);
}

TEST(PoseScorer, FarAwayTheMapIsUnknown) {
  Random random(4);
  const auto points = ends(20, random);
  const OccupancyMap map = mapOf(points);
  EXPECT_EQ(PoseScorer(map, points).score(Pose2(1e12, -1e300, 0.0)), 0.5);
}

// Under the undefined-behavior sanitizer: none of it may be cast to a cell.
TEST(PoseScorer, NonFinitePointsAreOutsideTheMap) {
  Random random(5);
  auto points = ends(20, random);
  const OccupancyMap map = mapOf(points);
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(PoseScorer(map, points).score(Pose2(0.0, 0.0, kNan)), 0.5);
  const double front = map.occupancy(map.window().cellAt(points.front().position));
  const double expected =
      meanOccupancy(map, points, Pose2()) + (0.5 - front) / static_cast<double>(points.size());
  for (const double spoiled : {kNan, std::numeric_limits<double>::infinity()}) {
    auto some = points;
    some.front().position.x() = spoiled;
    const PoseScorer scorer(map, some);
    EXPECT_NEAR(scorer.score(Pose2()), expected, 1e-12);
    EXPECT_EQ(scorer.bestOf({Pose2(1e12, 0.0, 0.0), Pose2()}).x(), 0.0);
  }
}

}  // namespace
}  // namespace datmo::pose_scorer_test
