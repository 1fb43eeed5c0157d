// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/slam/map_keeper.h"

#include <vector>

#include "walls.h"
#include <gtest/gtest.h>

#include "datmo_fusion/common/square.h"

namespace datmo::map_keeper_test {
namespace {

const Pose2 kStart(200.0, 0.0, 0.0);  // far from the origin, about which the frame turns
constexpr double kFarthest = 36.6;    // m, ahead of base, where a beam last ends on a wall
constexpr double kStep = 0.2;         // m, between scans
constexpr double kInterval = 0.1;     // s
constexpr int kScansBefore = 30;      // the gap
constexpr int kScansAfter = 48;       // until just before the search is given up

/// A vehicle between two walls, whose maps are kept, with a gap of sensors on the way.
class MapKeeperTest : public testing::Test {
 protected:
  /// Writes a scan from the true pose to the map, at the estimated one.
  void write(const Pose2& truth, const Pose2& pose) {
    const Scan scan = betweenWalls(truth, seconds_, false);
    keeper_.map().centerOn(pose.position());
    const std::vector<PointState> states(scan.rays.size(), PointState::kUnknown);
    keeper_.map().update(scan, states, pose);
    seconds_ += kInterval;
  }

  Stamp now() const { return Stamp::fromSeconds(1000.0 + seconds_); }

  /// Drives up to the gap, leaves the map there with an estimate that is off and this uncertain.
  void driveIntoGap(const Pose2& off, const Eigen::Vector3d& sigma) {
    for (int i = 0; i < kScansBefore; ++i, truth_ = truth_ * Pose2(kStep, 0.0, 0.0)) {
      write(truth_, truth_);
    }
    pose_ = keeper_.leave({truth_ * off, sigma.cwiseAbs2().asDiagonal()}, now());
  }

  /// Drives on until the maps are one again, at most until just before the search ends. Returns
  /// whether they are.
  bool driveOn() {
    for (int i = 0; i < kScansAfter; ++i) {
      write(truth_, pose_.pose);
      before_ = keeper_.inFirstMap(pose_);
      const MapKeeper::SearchStep step = keeper_.search(pose_, now());
      if (step.found) {
        pose_ = *step.found;
        return true;
      }
      truth_ = truth_ * Pose2(kStep, 0.0, 0.0);
      pose_.pose = pose_.pose * Pose2(kStep, 0.0, 0.0);
    }
    return false;
  }

  /// Whether the map has hits on the left wall at this distance along it.
  bool hasWallAt(double x) const { return keeper_.map().hitsAround({x, 5.0}).has_value(); }

  MapKeeper keeper_{OccupancyMapOptions{}, MapRecoveryOptions{}, ScalePrior{}};
  double seconds_ = 0.0;
  Pose2 truth_ = kStart;
  PoseWithCovariance pose_;
  PoseWithCovariance before_;  ///< in the first map, before the last search
};

TEST_F(MapKeeperTest, AlignedMapsAreMergedAndTheUncertaintyAlongTheWallsStays) {
  driveIntoGap(Pose2(0.4, 0.3, degrees(4.0)), {0.8, 0.4, degrees(5.0)});
  ASSERT_TRUE(driveOn());
  const PoseWithCovariance after = keeper_.inFirstMap(pose_);
  EXPECT_NEAR(after.pose.y(), truth_.y(), 0.2);
  EXPECT_NEAR(after.pose.heading(), truth_.heading(), degrees(1.0));
  EXPECT_GT(after.covariance(0, 0), square(0.6)) << "nothing tells how far it went";
  EXPECT_LT(after.covariance(1, 1), square(0.6)) << "though the frame's origin is far";
  EXPECT_LT(after.covariance(2, 2), 0.5 * before_.covariance(2, 2));
  EXPECT_EQ(keeper_.mapsBegun(), 0);
  EXPECT_EQ(keeper_.localization(), Localization::kLocated);
  ASSERT_GT(truth_.x(), kStart.x() + kStep * kScansBefore + 2.0);
  EXPECT_TRUE(hasWallAt(kStart.x() + 5.0)) << "of the older map";
  EXPECT_TRUE(hasWallAt(truth_.x() + kFarthest - 1.0)) << "of the newer one";
  EXPECT_FALSE(hasWallAt(truth_.x() + kFarthest + 2.0)) << "of neither";
}

TEST_F(MapKeeperTest, WithAPriorMapNothingIsMerged) {
  keeper_.setPriorMap({OccupancyMap{OccupancyMapOptions{}}, {}});
  driveIntoGap(Pose2(0.4, 0.3, degrees(4.0)), {0.8, 0.4, degrees(5.0)});
  EXPECT_FALSE(driveOn());
}

}  // namespace
}  // namespace datmo::map_keeper_test
