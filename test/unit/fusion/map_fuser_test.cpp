// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/fusion/map/map_fuser.h"

#include <cmath>
#include <limits>
#include <stdexcept>

#include "map_samples.h"
#include <gtest/gtest.h>

#include "datmo_fusion/slam/pose_covariance.h"

namespace datmo::map_fuser_test {
namespace {

using namespace map_samples;

class MapFuserTest : public testing::Test {
 protected:
  MapFuserTest() : MapFuserTest(MapFuserOptions()) {}
  explicit MapFuserTest(MapFuserOptions options) : options_(std::move(options)) {
    options_.map = evenLooks();
    options_.sources["lidar"].reliability = 1.0;
    options_.sources["stereo"].reliability = 1.0;
    fuser_ = MapFuser(options_);
    fuser_.moveTo(poseOf(Pose2()));
  }

  void take(const std::string& source, Percent percent, double seconds = 0.0) {
    fuser_.add(source, gridWith(kCell, percent, seconds), Pose2(), {});
  }

  void setPrior(CellIndex cell, double log_odds) {
    OccupancyMapOptions map;
    map.window = {20.0, 10.0, 1.0};
    MapEvidence evidence{1.0, {}};
    for (int row = -5; row < 5; ++row) {
      for (int column = -10; column < 10; ++column) {
        evidence.cells.push_back({{column, row}, -3.0F, 0.0F, 0, 0, {}});
      }
    }
    evidence.cells.push_back({cell, static_cast<float>(log_odds), 0.0F, 0, 0, {}});
    fuser_.setPrior(OccupancyMap::restored(map, evidence));
  }

  MapFuserOptions options_;
  MapFuser fuser_{options_};
};

TEST_F(MapFuserTest, TwoThatAgreeAreMoreCertainThanOne) {
  take("lidar", kOccupied);
  EXPECT_EQ(fuser_.fuse(stampAt(0.0))->fused.at(kCell), kOccupied);
  take("stereo", kOccupied);
  const auto maps = fuser_.fuse(stampAt(0.0));
  EXPECT_EQ(maps->fused.at(kCell), 94) << "odds of 4 x 4 to 1";
  EXPECT_EQ(maps->conflict.at(kCell), 0);
  EXPECT_EQ(maps->conflict.at({4, 1}), kUnknownPercent);
  EXPECT_EQ(maps->cells_in_conflict, 0);
  EXPECT_FALSE(maps->changes);
}

TEST_F(MapFuserTest, TwoThatContradictAreAConflict) {
  take("lidar", kOccupied);
  take("stereo", kFree);
  const auto maps = fuser_.fuse(stampAt(0.0));
  EXPECT_EQ(maps->fused.at(kCell), kUndecidedPercent);
  EXPECT_EQ(maps->conflict.at(kCell), 36) << "0.6 for each side";
  EXPECT_EQ(maps->cells_in_conflict, 1);
}

TEST_F(MapFuserTest, AnAgedOneIsLessInformative) {
  take("lidar", kOccupied, 0.0);
  take("stereo", kFree, kTimeConstant);
  const auto maps = fuser_.fuse(stampAt(kTimeConstant));
  // ln 4 / e is 62 percent: odds of 62 / 38 / 4.
  EXPECT_EQ(maps->fused.at(kCell), 29);
  EXPECT_EQ(maps->conflict.at(kCell), 14);
  EXPECT_EQ(maps->cells_in_conflict, 0);
}

TEST_F(MapFuserTest, ReliabilityBoundsTheEvidenceOfRepeatedObservations) {
  options_.sources["lidar"].reliability = 0.5;
  fuser_ = MapFuser(options_);
  for (int i = 0; i < 20; ++i) {
    take("lidar", kOccupied, 0.1 * i);
  }
  take("stereo", kFree, 2.0);
  take("stereo", kFree, 2.1);
  // 98 percent, half believed, are 74 percent; against odds of 16 to 1 (94 percent).
  EXPECT_NEAR(fuser_.fuse(stampAt(2.1))->fused.at(kCell), 15, 1);
}

TEST_F(MapFuserTest, WithoutReliabilityItIsNoSource) {
  options_.sources["stereo"].reliability = 0.0;
  fuser_ = MapFuser(options_);
  EXPECT_EQ(options_.sourcesInUse(), std::vector<std::string>{"lidar"});
  EXPECT_THROW(take("stereo", kOccupied), std::out_of_range);
  EXPECT_FALSE(fuser_.fuse(stampAt(0.0))) << "no map yet";
}

TEST_F(MapFuserTest, MovingObjectsAreNotInTheMaps) {
  const Point2 mover = kWindow.centerOf(kCell) + Point2(0.6, 0.0);
  fuser_.add("lidar", gridWith(kCell, kOccupied, 0.0), Pose2(), {mover});
  EXPECT_EQ(fuser_.fuse(stampAt(0.0))->fused.at(kCell), kUnknownPercent);
  fuser_.add("lidar", gridWith(kCell, kFree, 0.1), Pose2(), {mover});
  EXPECT_EQ(fuser_.fuse(stampAt(0.1))->fused.at(kCell), kFree);
}

TEST_F(MapFuserTest, TheMapsMoveWithTheVehicle) {
  take("lidar", kOccupied);
  fuser_.moveTo(poseOf(Pose2(8.0, 0.0, 0.0)));
  const auto maps = fuser_.fuse(stampAt(0.0));
  EXPECT_EQ(maps->fused.window().corner, (CellIndex{-2, -5}));
  EXPECT_EQ(maps->fused.at(kCell), kOccupied);
  fuser_.add("stereo", gridWith(kCell, kOccupied, 0.1), Pose2(8.0, 0.0, 0.0), {});
  EXPECT_EQ(fuser_.fuse(stampAt(0.1))->fused.at({11, 1}), kOccupied) << "seen from there";
  fuser_.add("stereo", gridWith({-5, 1}, kOccupied, 0.2), Pose2(8.0, 0.0, 0.0), {});
  EXPECT_EQ(fuser_.fuse(stampAt(0.2))->fused.at(kCell), 94);
}

TEST_F(MapFuserTest, AfterAGapTheMapsStartOver) {
  take("lidar", kOccupied);
  fuser_.moveTo(poseOf(Pose2(), 0.4));
  EXPECT_EQ(fuser_.mapsBegun(), 0);
  fuser_.moveTo(poseOf(Pose2(), 2.0));
  EXPECT_EQ(fuser_.mapsBegun(), 1);
  EXPECT_FALSE(fuser_.fuse(stampAt(0.0)));
  take("lidar", kFree, 1.0);
  fuser_.moveTo(poseOf(Pose2(), 0.1));
  EXPECT_EQ(fuser_.mapsBegun(), 2) << "found again: elsewhere";
}

TEST_F(MapFuserTest, GapsAreThoseOfGridSlam) {
  take("lidar", kOccupied);
  fuser_.moveTo(poseOf(Pose2(), 0.504));
  EXPECT_EQ(fuser_.mapsBegun(), 1) << "0.25 m^2 more than 0.05 m squared";
}

TEST_F(MapFuserTest, AfterAnUnresolvedGapTheMapsContinue) {
  const auto uncertainSince = [](double x) {
    PoseWithCovariance pose = poseOf(Pose2(x, 0.0, 0.0));
    pose.covariance += withLeverArm(poseOf(Pose2(), 1.0, 0.5).covariance, pose.pose.position());
    return pose;
  };
  fuser_ = MapFuser(options_);
  for (const double x : {10.0, 12.0, 14.0, 11.0}) {
    fuser_.moveTo(uncertainSince(x));
  }
  EXPECT_EQ(fuser_.mapsBegun(), 0) << "the heading of the map is uncertain, not the position in it";
}

TEST_F(MapFuserTest, APoseJumpStartsTheMapsOver) {
  take("lidar", kOccupied);
  const Pose2 motion(1.0, 0.0, 0.0);
  fuser_.moveTo(poseOf(Pose2(2.5, 0.0, 0.0)), motion);
  EXPECT_EQ(fuser_.mapsBegun(), 0) << "a correction";
  fuser_.moveTo(poseOf(Pose2(6.0, 0.0, 0.0)), motion);
  EXPECT_EQ(fuser_.mapsBegun(), 1) << "grid_slam was started anew";
  fuser_.moveTo(poseOf(Pose2(12.0, 0.0, 0.0)));
  EXPECT_EQ(fuser_.mapsBegun(), 1) << "how far it drove is not known";
}

TEST_F(MapFuserTest, APriorMapIsOneMoreSource) {
  options_.prior_reliability = 1.0;
  fuser_ = MapFuser(options_);
  fuser_.moveTo(poseOf(Pose2()));
  setPrior(kCell, std::log(4.0));
  take("lidar", kOccupied);
  const auto maps = fuser_.fuse(stampAt(0.0));
  EXPECT_EQ(maps->fused.at(kCell), 94);
  EXPECT_LT(maps->fused.at({0, 0}), 10) << "known to the prior map alone";
  ASSERT_TRUE(maps->changes);
  EXPECT_EQ(maps->changes->appeared + maps->changes->vanished, 0);
}

TEST_F(MapFuserTest, WhileThePoseIsUncertainThePriorMapIsLeftOut) {
  fuser_.moveTo(poseOf(Pose2(), 1.0));
  setPrior(kCell, 3.0);
  take("lidar", kFree);
  const auto maps = fuser_.fuse(stampAt(0.0));
  EXPECT_FALSE(maps->changes);
  EXPECT_EQ(maps->fused.at(kCell), kFree);
  EXPECT_EQ(maps->fused.at({0, 0}), kUnknownPercent);
  fuser_.moveTo(poseOf(Pose2(), std::numeric_limits<double>::quiet_NaN()));
  take("lidar", kFree, 1.0);
  EXPECT_FALSE(fuser_.fuse(stampAt(1.0))->changes) << "not a number is not sure";
}

}  // namespace
}  // namespace datmo::map_fuser_test
