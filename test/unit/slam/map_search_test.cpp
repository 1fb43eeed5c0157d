// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/slam/map_search.h"

#include <cmath>
#include <functional>
#include <memory>

#include "walls.h"
#include <gtest/gtest.h>

#include "datmo_fusion/common/square.h"
#include "datmo_fusion/common/twist2.h"

namespace datmo::map_search_test {
namespace {

using Outcome = MapSearch::Outcome;

/// Scans of a world from poses.
using World = std::function<Scan(const Pose2& base, double seconds)>;

Scan yard(const Pose2& base, double seconds) { return Yard().scan(base, seconds); }

Scan street(const Pose2& base, double seconds) { return betweenWalls(base, seconds, true); }

Scan corridor(const Pose2& base, double seconds) { return betweenWalls(base, seconds, false); }

/// A map of 2 s of driving straight from a pose at 2 m/s, where that pose is `in_map`.
OccupancyMap mapOf(const World& world, const Pose2& from, const Pose2& in_map) {
  OccupancyMap map{OccupancyMapOptions{}};
  for (int i = 0; i <= 20; ++i) {
    const Pose2 motion = arc({2.0, 0.0}, 0.1 * i);
    map.centerOn((in_map * motion).position());
    const Scan scan = world(from * motion, 0.1 * i);
    map.update(scan, std::vector<PointState>(scan.rays.size(), PointState::kUnknown),
               in_map * motion);
  }
  return map;
}

std::shared_ptr<const SearchedMap> searched(const OccupancyMap& map) {
  return std::make_shared<const SearchedMap>(map);
}

/// Searches for a newer map that begins `ahead` of an older one, with a prior error of `off`.
MapSearch search(const World& world, const Pose2& ahead, const Pose2& off,
                 const Eigen::Vector3d& sigma, const MapSearchOptions& options = {}) {
  const OccupancyMap older = mapOf(world, Pose2(), Pose2());
  const Pose2 guess = ahead * off;
  const OccupancyMap newer = mapOf(world, ahead, guess);
  const Eigen::Matrix3d covariance = sigma.cwiseAbs2().asDiagonal();
  return MapSearch(options, searched(older), newer, {{guess, covariance}}, guess);
}

Outcome finish(MapSearch& search) {
  Outcome outcome = Outcome::kUnfinished;
  while (outcome == Outcome::kUnfinished) {
    outcome = search.advance(1000);
  }
  return outcome;
}

void expectFound(MapSearch& search, const Pose2& truth) {
  ASSERT_EQ(finish(search), Outcome::kFound);
  const PoseWithCovariance found = search.found();
  EXPECT_LT((found.pose.position() - truth.position()).norm(), 0.6);
  EXPECT_NEAR(angleBetween(truth.heading(), found.pose.heading()), 0.0, degrees(2.0));
  EXPECT_LT(found.covariance(0, 0), 1.0);
  EXPECT_GE(found.covariance(0, 0), 0.09);
}

TEST(MapSearchTest, FindsAPoseMetersAndManyDegreesFromThePrior) {
  const Pose2 ahead(8.0, 1.0, 0.1);
  for (const Pose2& off : {Pose2(1.5, 1.0, 0.0), Pose2(-2.0, -1.0, 0.2), Pose2(0.0, 0.0, -0.4)}) {
    MapSearch found = search(yard, ahead, off, {2.0, 1.5, 0.3});
    expectFound(found, ahead);
  }
}

TEST(MapSearchTest, TheWorkMayBeSpreadOverCalls) {
  const Pose2 ahead(8.0, 1.0, 0.1);
  MapSearch whole = search(yard, ahead, Pose2(1.5, 1.0, 0.0), {2.0, 1.5, 0.3});
  MapSearch in_parts = search(yard, ahead, Pose2(1.5, 1.0, 0.0), {2.0, 1.5, 0.3});
  ASSERT_EQ(finish(whole), Outcome::kFound);
  EXPECT_EQ(in_parts.advance(10), Outcome::kUnfinished);
  while (in_parts.advance(10) == Outcome::kUnfinished) {
  }
  EXPECT_EQ(in_parts.found().pose.position(), whole.found().pose.position());
}

TEST(MapSearchTest, AlongAStreetThatRepeatsNothingIsFound) {
  MapSearch found = search(street, Pose2(8.0, 0.0, 0.0), Pose2(), {5.0, 0.3, 0.05});
  EXPECT_EQ(finish(found), Outcome::kAmbiguous);
  ASSERT_TRUE(found.likeliest());
  EXPECT_NEAR(found.likeliest()->y(), 0.0, 0.3);
}

TEST(MapSearchTest, AlongWallsTheMapsAreAlignedAsFarAsThePriorReaches) {
  const Pose2 ahead(8.0, 0.0, 0.0);
  MapSearch aligned = search(corridor, ahead, Pose2(0.5, 0.4, 0.1), {1.0, 0.5, 0.1});
  ASSERT_EQ(finish(aligned), Outcome::kAligned);
  const PoseWithCovariance found = aligned.aligned();
  EXPECT_NEAR(found.pose.y(), ahead.y(), 0.2);
  EXPECT_NEAR(found.pose.heading(), ahead.heading(), degrees(1.0));
  EXPECT_NEAR(found.pose.x(), ahead.x() + 0.5, 0.2) << "nothing but the prior tells";
  EXPECT_GT(found.covariance(0, 0), 0.8);
  EXPECT_LT(found.covariance(1, 1), 0.25);
  EXPECT_LT(found.covariance(2, 2), square(degrees(2.0)));
}

TEST(MapSearchTest, TheCovarianceReachesUnlikelyPosesThatNothingContradicts) {
  MapSearchOptions options;
  options.max_aligned_sigma = 5.0;
  const Pose2 ahead(8.0, 0.0, 0.0);
  MapSearch aligned = search(street, ahead, Pose2(), {2.1, 0.3, 0.02}, options);
  ASSERT_EQ(finish(aligned), Outcome::kAligned);
  const PoseWithCovariance found = aligned.aligned();
  EXPECT_NEAR(found.pose.x(), ahead.x(), 0.5) << "one of the poses that fit";
  // The pillars fit 7 m away as well: at max_log_ratio = 6, sqrt(12) standard deviations.
  EXPECT_GE(found.covariance(0, 0), square(7.0 / std::sqrt(12.0)) - 0.3);
}

TEST(MapSearchTest, MapsMayNeverBeAligned) {
  MapSearchOptions options;
  options.max_aligned_sigma = 0.0;
  const Eigen::Vector3d sigma(1.0, 0.5, 0.1);
  MapSearch in_corridor = search(corridor, Pose2(8.0, 0.0, 0.0), Pose2(), sigma, options);
  EXPECT_EQ(finish(in_corridor), Outcome::kAmbiguous);
  MapSearch in_yard = search(yard, Pose2(8.0, 1.0, 0.1), Pose2(), sigma, options);
  EXPECT_EQ(finish(in_yard), Outcome::kFound);
}

TEST(MapSearchTest, InACompleteMapThePoseIsRefined) {
  const OccupancyMap older = mapOf(yard, Pose2(), Pose2());
  const Pose2 ahead(6.0, 1.0, 0.2);
  const OccupancyMap newer = mapOf(yard, ahead, Pose2());
  const Eigen::Matrix3d covariance = Eigen::Vector3d(1.0, 1.0, 0.05).asDiagonal();
  MapSearch found(MapSearchOptions::inCompleteMap(), searched(older), newer, {{ahead, covariance}},
                  Pose2());
  ASSERT_EQ(finish(found), Outcome::kFound);
  EXPECT_LT((found.found().pose.position() - ahead.position()).norm(), 0.2);
  EXPECT_NEAR(angleBetween(ahead.heading(), found.found().pose.heading()), 0.0, degrees(1.0));
  EXPECT_LT(found.found().covariance(0, 0), 0.25);
}

TEST(MapSearchTest, InAnotherPlaceNothingIsFound) {
  const OccupancyMap older = mapOf(yard, Pose2(), Pose2());
  const OccupancyMap newer = mapOf(street, Pose2(), Pose2(8.0, 0.0, 0.0));
  const Eigen::Matrix3d covariance = Eigen::Vector3d(4.0, 4.0, 0.1).asDiagonal();
  MapSearch found({}, searched(older), newer, {{Pose2(8.0, 0.0, 0.0), covariance}},
                  Pose2(8.0, 0.0, 0.0));
  EXPECT_NE(finish(found), Outcome::kFound);
}

TEST(MapSearchTest, AnEmptyMapIsAmbiguous) {
  const OccupancyMap empty{OccupancyMapOptions{}};
  MapSearch found({}, searched(empty), empty, {{Pose2(), Eigen::Matrix3d::Identity()}}, Pose2());
  EXPECT_EQ(found.advance(1), Outcome::kAmbiguous);
}

TEST(MapSearchTest, BeyondTheMapNothingIsFound) {
  const OccupancyMap older = mapOf(yard, Pose2(), Pose2());
  const Pose2 far(500.0, 0.0, 0.0);
  const OccupancyMap newer = mapOf(yard, Pose2(), far);
  MapSearch found({}, searched(older), newer, {{far, Eigen::Matrix3d::Identity()}}, far);
  EXPECT_EQ(finish(found), Outcome::kAmbiguous);
}

}  // namespace
}  // namespace datmo::map_search_test
