// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "yard.h"
#include <gtest/gtest.h>

#include "datmo_fusion/common/twist2.h"
#include "datmo_fusion/sensor_model/lidar_grid.h"
#include "datmo_fusion/slam/grid_slam.h"

namespace datmo::fused_slam_test {
namespace {

/// The yard as seen by a scanner alone.
SensorGrid gridOf(const Scan& scan) {
  static const LidarGridModel model{LidarGridOptions{}};
  return model.grid(scan);
}

/// Drives a gentle curve at 4 m/s on grids of the scans, 10 per second; returns the error at the
/// end, m.
double errorAfterDrive(GridSlam& slam, bool with_scans) {
  const Yard yard;
  const Twist2 twist{4.0, 0.05};
  Pose2 truth;
  Pose2 estimate;
  for (int i = 0; i < 60; ++i) {
    const double seconds = 0.1 * i;
    slam.addOdometry({Stamp::fromSeconds(1000.0 + seconds), {4.2, 0.05 + degrees(1.0)}});
    truth = arc(twist, seconds);
    Scan scan = yard.scan(truth, seconds);
    const SensorGrid grid = gridOf(scan);
    if (!with_scans) {
      scan.rays.clear();
    }
    estimate = slam.process(grid, scan).labeled_scan.base_in_map.pose;
  }
  return (estimate.position() - truth.position()).norm();
}

TEST(FusedSlamTest, WithScansThroughTheGridItIsAsAccurateAsWithScans) {
  GridSlam slam{GridSlamOptions{}};
  EXPECT_LT(errorAfterDrive(slam, true), 0.15);  // odometry alone: 1.2 m and 6 degrees
}

TEST(FusedSlamTest, WithCellsAloneItsErrorIsBelowTheirSize) {
  GridSlamOptions options;
  options.grid_ends = GridEnds::kCells;
  GridSlam slam{options};
  EXPECT_LT(errorAfterDrive(slam, true), options.map.window.cell_size);
}

TEST(FusedSlamTest, WithASilentScannerTheGridIsUsed) {
  GridSlam slam{GridSlamOptions{}};
  EXPECT_LT(errorAfterDrive(slam, false), GridSlamOptions{}.map.window.cell_size);
}

/// The result of a scan that follows 20 scans of the empty yard.
class FusedSlamInTheYard : public testing::Test {
 protected:
  FusedSlamInTheYard() {
    for (int i = 0; i < 20; ++i) {
      const Scan scan = yard_.scan(Pose2(), 0.1 * i);
      slam_.process(gridOf(scan), scan);
    }
  }

  static int moving(const SlamResult& result) {
    int count = 0;
    for (const ScanPoint& point : result.labeled_scan.points) {
      count += point.state == PointState::kMoving ? 1 : 0;
    }
    return count;
  }

  Yard yard_;
  GridSlam slam_{GridSlamOptions{}};
  Box2 box_{Pose2(9.0, 0.0, 0.0), 1.0, 2.0};
};

TEST_F(FusedSlamInTheYard, PointsConfirmedByTheGridMoveAndAreNotMapped) {
  const Scan scan = yard_.scan(Pose2(), 2.0, &box_);
  EXPECT_GE(moving(slam_.process(gridOf(scan), scan)), 5);
  EXPECT_LT(slam_.map().occupancy(slam_.map().window().cellAt({8.5, 0.0})), 0.3);
}

TEST_F(FusedSlamInTheYard, EndsRefutedByTheGridAreNoPoints) {
  const Scan scan = yard_.scan(Pose2(), 2.0, &box_);
  const SlamResult result = slam_.process(gridOf(yard_.scan(Pose2(), 2.0)), scan);
  EXPECT_EQ(moving(result), 0);
  for (const ScanPoint& point : result.labeled_scan.points) {
    EXPECT_GT(box_.distanceTo(point.position), 0.5);
  }
  EXPECT_GE(result.labeled_scan.blind_beams.size(), 5U) << "contested beams tell nothing";
  EXPECT_EQ(result.labeled_scan.blind_beams.size() + result.labeled_scan.points.size(), 81U);
}

TEST_F(FusedSlamInTheYard, CellsOfOthersAloneDoNotMoveAndAreMappedInUnknownSpace) {
  const Scan scan = yard_.scan(Pose2(), 2.0);
  SensorGrid grid = gridOf(scan);
  const CellIndex in_free_space = grid.window().cellAt({9.0, 0.0});
  const CellIndex behind = grid.window().cellAt({-5.0, 0.0});
  grid.at(in_free_space) = 80;
  grid.at(behind) = 80;
  const SlamResult result = slam_.process(grid, scan);
  EXPECT_EQ(moving(result), 0);
  const Pose2 base = result.labeled_scan.base_in_map.pose;
  const auto occupancy = [&](CellIndex cell) {
    return slam_.map().occupancy(slam_.map().window().cellAt(base * grid.window().centerOf(cell)));
  };
  EXPECT_LT(occupancy(in_free_space), 0.5);
  EXPECT_GT(occupancy(behind), 0.6);
}

TEST_F(FusedSlamInTheYard, TheMapKeepsItsWallsWhileTheVehicleTurns) {
  for (int i = 0; i < 40; ++i) {
    const Scan scan = yard_.scan(Pose2(0.0, 0.0, 0.01 * i), 2.0 + 0.1 * i);
    slam_.process(gridOf(scan), scan);
  }
  // The wall 25 m + 15 m ahead.
  int walled = 0;
  for (int y = -10; y <= 10; ++y) {
    bool wall = false;
    for (const double x : {39.6, 39.9, 40.2, 40.5}) {
      wall = wall ||
             slam_.map().occupancy(slam_.map().window().cellAt({x, static_cast<double>(y)})) > 0.7;
    }
    walled += wall ? 1 : 0;
  }
  EXPECT_GE(walled, 15);
}

}  // namespace
}  // namespace datmo::fused_slam_test
