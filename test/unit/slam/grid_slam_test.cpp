// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/slam/grid_slam.h"

#include <algorithm>
#include <cmath>

#include "yard.h"
#include <gtest/gtest.h>

namespace datmo::grid_slam_test {
namespace {

/// Drives a gentle curve at 4 m/s, 10 scans per second; returns the last result and the true pose.
struct Drive {
  SlamResult result;
  Pose2 truth;
};

Drive drive(GridSlam& slam, const Twist2& odometry_error, bool with_odometry, int scans = 60) {
  const Yard yard;
  Drive drive;
  const Twist2 twist{4.0, 0.05};
  for (int i = 0; i < scans; ++i) {
    const double seconds = 0.1 * i;
    if (with_odometry) {
      slam.addOdometry({Stamp::fromSeconds(1000.0 + seconds),
                        {twist.forward_speed + odometry_error.forward_speed,
                         twist.yaw_rate + odometry_error.yaw_rate}});
    }
    drive.truth = arc(twist, seconds);
    drive.result = slam.process(yard.scan(drive.truth, seconds));
  }
  return drive;
}

double positionError(const Drive& drive) {
  return (drive.result.labeled_scan.base_in_map.pose.position() - drive.truth.position()).norm();
}

TEST(GridSlamTest, TheFirstPoseIsTheOrigin) {
  GridSlam slam{GridSlamOptions{}};
  const SlamResult result = slam.process(Yard().scan(Pose2(), 0.0));
  EXPECT_EQ(result.labeled_scan.base_in_map.pose.position(), Point2::Zero());
  EXPECT_FALSE(result.match.accepted);
  EXPECT_EQ(result.labeled_scan.points.size(), 81U);
}

TEST(GridSlamTest, CorrectsBiasedOdometry) {
  GridSlam slam{GridSlamOptions{}};
  const Drive end = drive(slam, {0.2, degrees(1.0)}, true);
  EXPECT_LT(positionError(end), 0.15);  // odometry alone: 1.2 m and 6 degrees
  EXPECT_NEAR(angleBetween(end.truth.heading(), end.result.labeled_scan.base_in_map.pose.heading()),
              0.0, degrees(0.5));
}

TEST(GridSlamTest, LateOdometryIsNotTakenForCurrent) {
  // A turn that begins immediately, which odometry reports one and a half scans later.
  constexpr double kPeriod = 0.06;
  constexpr double kLate = 0.1;
  const auto twistAt = [](double seconds) { return Twist2{4.0, seconds < 1.0 ? 0.0 : 0.6}; };
  GridSlam slam{GridSlamOptions{}};
  const Yard yard;
  Drive end;
  double sent = 0.0;
  for (int i = 0; i < 30; ++i) {
    const double seconds = kPeriod * i;
    for (; sent <= seconds - kLate; sent += 0.02) {
      slam.addOdometry({Stamp::fromSeconds(1000.0 + sent), twistAt(sent)});
    }
    end.truth =
        arc({4.0, 0.0}, std::min(seconds, 1.0)) * arc({4.0, 0.6}, std::max(0.0, seconds - 1.0));
    end.result = slam.process(yard.scan(end.truth, seconds));
    EXPECT_NEAR(
        angleBetween(end.truth.heading(), end.result.labeled_scan.base_in_map.pose.heading()), 0.0,
        degrees(1.0))
        << "at " << seconds;
  }
  EXPECT_FALSE(end.result.odometry_used);
  EXPECT_LT(positionError(end), 0.2);
}

TEST(GridSlamTest, WorksWithoutOdometry) {
  GridSlam slam{GridSlamOptions{}};
  const Drive end = drive(slam, {}, false);
  EXPECT_FALSE(end.result.odometry_used);
  EXPECT_LT(positionError(end), 0.3);
}

TEST(GridSlamTest, AYawRateAloneIsUsedWithoutASpeed) {
  GridSlam slam{GridSlamOptions{}};
  const Yard yard;
  const Twist2 twist{4.0, 0.4};
  Drive end;
  for (int i = 0; i < 40; ++i) {
    OdometrySample gyroscope{Stamp::fromSeconds(1000.0 + 0.1 * i), {0.0, twist.yaw_rate}};
    gyroscope.speed_measured = false;
    slam.addOdometry(gyroscope);
    end.truth = arc(twist, 0.1 * i);
    end.result = slam.process(yard.scan(end.truth, 0.1 * i));
  }
  EXPECT_FALSE(end.result.odometry_used) << "not all of the motion was measured";
  EXPECT_LT(positionError(end), 0.3);
  EXPECT_NEAR(angleBetween(end.truth.heading(), end.result.labeled_scan.base_in_map.pose.heading()),
              0.0, degrees(1.0));
}

TEST(GridSlamTest, ScansAlmostAtOnceDoNotMakeAVelocity) {
  // A driver that stamps on arrival: two scans arrive within a microsecond, then nothing for 0.2 s.
  GridSlam slam{GridSlamOptions{}};
  const Yard yard;
  Drive end;
  for (int i = 0; i < 30; ++i) {
    const double seconds = 0.2 * i;
    end.truth = arc({2.0, 0.05}, seconds);
    slam.process(yard.scan(end.truth, seconds));
    end.result = slam.process(yard.scan(end.truth, seconds + 1e-6));
  }
  EXPECT_LT(positionError(end), 0.3);
}

TEST(GridSlamTest, AnObjectEnteringFreeSpaceIsMovingAndNotMapped) {
  GridSlam slam{GridSlamOptions{}};
  const Yard yard;
  for (int i = 0; i < 20; ++i) {
    slam.process(yard.scan(Pose2(), 0.1 * i));
  }
  const Box2 box{Pose2(9.0, 0.0, 0.0), 1.0, 2.0};
  const SlamResult result = slam.process(yard.scan(Pose2(), 2.0, &box));
  int on_box = 0;
  for (const ScanPoint& point : result.labeled_scan.points) {
    const bool is_on_box = box.distanceTo(point.position) < 0.01;
    on_box += is_on_box ? 1 : 0;
    EXPECT_EQ(point.state, is_on_box ? PointState::kMoving : PointState::kStatic)
        << "beam " << point.beam << " at " << point.position.transpose();
  }
  EXPECT_GE(on_box, 5);
  EXPECT_LT(slam.map().occupancy(slam.map().window().cellAt({8.5, 0.0})), 0.3);
}

TEST(GridSlamTest, AScanWithoutRaysMovesByOdometryAlone) {
  GridSlam slam{GridSlamOptions{}};
  slam.addOdometry({Stamp::fromSeconds(1000.0), {4.0, 0.0}});
  slam.process(Yard().scan(Pose2(), 0.0));
  Scan empty;
  empty.stamp = Stamp::fromSeconds(1000.1);
  const SlamResult result = slam.process(empty);
  EXPECT_FALSE(result.match.accepted);
  EXPECT_NEAR(result.labeled_scan.base_in_map.pose.x(), 0.4, 1e-9);
  EXPECT_TRUE(result.labeled_scan.points.empty());
}

TEST(GridSlamTest, TheLabeledScanHasBeamsWithoutReturn) {
  Scan scan;
  scan.stamp = Stamp::fromSeconds(1000.0);
  scan.field = {degrees(-2.0), degrees(1.0), 5, 0.5, 40.0, 80.0};
  for (const std::uint32_t beam : {1U, 2U}) {
    Ray ray;
    ray.beam = beam;
    ray.hit = beam == 2;
    ray.range = 10.0;
    ray.end = Point2(10.0, 0.0);
    scan.rays.push_back(ray);
  }
  const LabeledScan split = GridSlam{GridSlamOptions{}}.process(scan).labeled_scan;
  EXPECT_EQ(split.field.beams, 5U);
  EXPECT_EQ(split.field.range, 80.0);
  ASSERT_EQ(split.points.size(), 1U);
  EXPECT_EQ(split.points[0].beam, 2U);
  EXPECT_EQ(split.blind_beams, (std::vector<std::uint32_t>{0, 3, 4})) << "beam 1: no return";
}

/// Between two endless walls, 4 m to the left and 5 m to the right.
Scan corridorScan(double seconds) {
  Scan scan;
  scan.stamp = Stamp::fromSeconds(1000.0 + seconds);
  scan.field.beam_spacing = degrees(2.0);
  for (std::uint32_t beam = 0; beam < 81; ++beam) {
    Ray ray;
    ray.beam = beam;
    ray.bearing = degrees(-80.0 + 2.0 * beam);
    const double across = std::sin(ray.bearing);
    constexpr double kFarthest = 50.0;
    ray.range = std::min(kFarthest, std::abs((across > 0.0 ? 4.0 : 5.0) / across));
    ray.hit = ray.range < kFarthest;
    ray.end = ray.range * Point2(std::cos(ray.bearing), across);
    scan.rays.push_back(ray);
  }
  return scan;
}

TEST(GridSlamTest, BetweenEndlessWallsTheDistanceIsLeftToTheOdometry) {
  // The scans are all alike. Standing still would fit them best; the odometry knows better.
  GridSlam slam{GridSlamOptions{}};
  SlamResult result;
  for (int i = 0; i <= 40; ++i) {
    slam.addOdometry({Stamp::fromSeconds(1000.0 + 0.1 * i), {5.0, 0.0}});
    result = slam.process(corridorScan(0.1 * i));
  }
  const PoseWithCovariance& pose = result.labeled_scan.base_in_map;
  EXPECT_NEAR(pose.pose.x(), 20.0, 0.5);
  EXPECT_NEAR(pose.pose.y(), 0.0, 0.1);
  EXPECT_GT(std::sqrt(pose.covariance(0, 0)), 4.0 * std::sqrt(pose.covariance(1, 1)));
  EXPECT_TRUE(result.match.degenerate);
}

TEST(GridSlamTest, TheSameInputGivesTheSameOutput) {
  GridSlam first{GridSlamOptions{}};
  GridSlam second{GridSlamOptions{}};
  const Pose2 a = drive(first, {0.1, 0.01}, true).result.labeled_scan.base_in_map.pose;
  const Pose2 b = drive(second, {0.1, 0.01}, true).result.labeled_scan.base_in_map.pose;
  EXPECT_EQ(a.position(), b.position());
  EXPECT_EQ(a.heading(), b.heading());
  first.reset();
  const Pose2 again = drive(first, {0.1, 0.01}, true).result.labeled_scan.base_in_map.pose;
  EXPECT_EQ(again.position(), b.position()) << "after a reset it runs as if it were new";
}

TEST(GridSlamTest, AGapOfThreeSecondsIsBridgedByOdometry) {
  GridSlam slam{GridSlamOptions{}};
  const Yard yard;
  const Twist2 twist{2.0, 0.0};
  Drive end;
  for (int i = 0; i < 70; ++i) {
    const double seconds = 0.1 * i;
    slam.addOdometry({Stamp::fromSeconds(1000.0 + seconds), {2.0, 0.003}});
    end.truth = arc(twist, seconds);
    if (i < 20 || i >= 50) {
      end.result = slam.process(yard.scan(end.truth, seconds));
    }
  }
  EXPECT_TRUE(end.result.odometry_used);
  EXPECT_LT(positionError(end), 0.15);
}

/// Turns on the spot at 0.4 rad/s for 2 s, then without a scan for this long, then for 2 s more;
/// the odometry has poses, and is silent for as long, plus `late` (s).
Drive driveOverAGap(double gap, double late) {
  GridSlam slam{GridSlamOptions{}};
  const Yard yard;
  const Twist2 twist{0.0, 0.4};
  Drive end;
  const int first_after = 20 + static_cast<int>(std::lround(10.0 * gap));
  for (int i = 0; i < first_after + 20; ++i) {
    const double seconds = 0.1 * i;
    end.truth = arc(twist, seconds);
    if (i < 20 || seconds > 0.1 * first_after + late - 1e-9) {
      slam.addOdometry({Stamp::fromSeconds(1000.0 + seconds), twist, end.truth});
    }
    if (i < 20 || i >= first_after) {
      end.result = slam.process(yard.scan(end.truth, seconds));
    }
  }
  return end;
}

TEST(GridSlamTest, AnEncoderCountsOverAGapOfScansAndOdometry) {
  for (const double gap : {1.0, 3.0, 5.0, 12.0}) {
    for (const double late : {0.0, 0.1, 0.5}) {
      const Drive end = driveOverAGap(gap, late);
      EXPECT_LT(positionError(end), 0.3) << gap << " s, odometry " << late << " s late";
      EXPECT_NEAR(
          angleBetween(end.truth.heading(), end.result.labeled_scan.base_in_map.pose.heading()),
          0.0, degrees(2.0))
          << gap << " s, odometry " << late << " s late";
    }
  }
}

TEST(GridSlamTest, WithoutScansThePoseFollowsTheOdometryIndefinitely) {
  GridSlam slam{GridSlamOptions{}};
  const Yard yard;
  Drive end;
  for (int i = 0; i < 400; ++i) {
    end.truth = arc({0.5, 0.1}, 0.1 * i);
    slam.addOdometry({Stamp::fromSeconds(1000.0 + 0.1 * i), {0.5, 0.1}});
    if (i < 20 || i >= 380) {
      end.result = slam.process(yard.scan(end.truth, 0.1 * i));
    }
  }
  EXPECT_TRUE(end.result.odometry_used);
  EXPECT_LT(positionError(end), 0.3);
}

TEST(GridSlamTest, RefusesBadOptionsByTheirFullName) {
  GridSlamOptions options;
  options.map.window.cell_size = -1.0;
  try {
    GridSlam slam(options);
    FAIL() << "no exception";
  } catch (const OptionError& error) {
    EXPECT_NE(std::string(error.what()).find("cell_size = -1"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace datmo::grid_slam_test
