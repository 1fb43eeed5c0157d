// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "made_worlds.h"
#include <gtest/gtest.h>

#include "datmo_fusion/slam/grid_slam.h"

namespace datmo::simulator::sweep_test {
namespace {

/// A scanner that takes 40 ms for its field of view drives through turns at up to 10 m/s. Without
/// odometry it starts slowly: at first its velocity is unknown.
constexpr double kSweep = 0.04;  // s
constexpr double kStart = 1000.0;

/// Walls and pillars along a road with two turns.
class Course {
 public:
  Course() : world_(RoadNetwork(), ego()) {
    const Polyline left{{-20.0, 8.0}, {32.0, 8.0}, {32.0, 58.0}, {120.0, 58.0}};
    const Polyline right{{-20.0, -8.0}, {48.0, -8.0}, {48.0, 42.0}, {120.0, 42.0}};
    for (const Polyline& side : {left, right}) {
      for (std::size_t i = 0; i + 1 < side.size(); ++i) {
        walls_.push_back({side[i], side[i + 1]});
      }
    }
    for (double arc_length = 10.0; arc_length < ego().path.length(); arc_length += 12.0) {
      const Pose2 location = ego().path.at(arc_length).pose;
      walls_.push_back({location * Point2(0.0, 5.0), location * Point2(0.0, 8.0)});
      walls_.push_back({location * Point2(6.0, -5.0), location * Point2(6.0, -8.0)});
    }
    for (const Segment& wall : walls_) {
      world_.addSolid({wall, 3.0, Surface::kBody, kNoObject});
    }
  }

  const World& world() const { return world_; }

  double distanceToWall(const Point2& point) const {
    double min = std::numeric_limits<double>::infinity();
    for (const Segment& wall : walls_) {
      const Point2 along = wall.end - wall.start;
      const double part = (point - wall.start).dot(along) / along.squaredNorm();
      const Point2 foot = wall.start + std::clamp(part, 0.0, 1.0) * along;
      min = std::min(min, (point - foot).norm());
    }
    return min;
  }

 private:
  static Mover ego() {
    return {objectKind("car"), Path({{0.0, 0.0}, {40.0, 0.0}, {40.0, 50.0}, {110.0, 50.0}}, 12.0),
            SpeedProfile({{0.0, 1.0}, {4.0, 10.0}}), 0.0};
  }

  World world_;
  std::vector<Segment> walls_;
};

Scan toScan(const EchoScan& echoes, const LaserScannerOptions& scanner) {
  Scan scan;
  scan.stamp = Stamp::fromSeconds(kStart + echoes.time);
  scan.scanner_in_base = Pose2(scanner.mount_x, scanner.mount_y, degrees(scanner.mount_heading));
  scan.field.beam_spacing = degrees(scanner.beam_spacing);
  for (std::uint32_t beam = 0; beam < echoes.beams.size(); ++beam) {
    if (echoes.beams[beam].empty()) {
      continue;
    }
    Ray ray;
    ray.beam = beam;
    ray.hit = true;
    ray.time = scanner.sweep_duration * beam / (scanner.beamCount() - 1);
    ray.range = echoes.beams[beam].front().range;
    ray.bearing = degrees(beam * scanner.beam_spacing - 0.5 * scanner.field_of_view);
    ray.origin = scan.scanner_in_base.position();
    ray.end = scan.scanner_in_base *
              Point2(ray.range * std::cos(ray.bearing), ray.range * std::sin(ray.bearing));
    scan.rays.push_back(ray);
  }
  return scan;
}

struct DriveErrors {
  double position = 0.0;  ///< m, root mean square over the drive
  double heading = 0.0;   ///< rad
  double ends = 0.0;      ///< m, root mean square distance of the scans' ends in the map from walls
};

DriveErrors drive(bool compensate, bool with_odometry) {
  const Course course;
  LaserScannerOptions options = idealScanner();
  options.mount_x = 3.6;
  options.sweep_duration = kSweep;
  options.range_noise = 0.02;
  LaserScanner scanner(options, RandomStream(1, "scanner"));
  GridSlamOptions slam_options;
  slam_options.motion_compensation = compensate;
  slam_options.matcher.point_sigma = 0.05;
  GridSlam slam(slam_options);
  const Pose2 map_in_world = course.world().at(0.0).base;
  DriveErrors errors;
  double ends = 0.0;
  constexpr int kScans = 120;
  for (int i = 0; i < kScans; ++i) {
    const double time = 0.1 * i;
    const WorldState state = course.world().at(time);
    if (with_odometry) {
      // The newest odometry available to a scan is that of its first beam.
      slam.addOdometry({Stamp::fromSeconds(kStart + time), state.twist});
    }
    const SlamResult result = slam.process(toScan(scanner.measure(course.world(), time), options));
    const Pose2 base = map_in_world * result.labeled_scan.base_in_map.pose;
    errors.position += (base.position() - state.base.position()).squaredNorm() / kScans;
    errors.heading += std::pow(angleBetween(base.heading(), state.base.heading()), 2) / kScans;
    for (const ScanPoint& point : result.labeled_scan.points) {
      errors.ends += std::pow(course.distanceToWall(base * point.position), 2);
      ++ends;
    }
  }
  return {std::sqrt(errors.position), std::sqrt(errors.heading), std::sqrt(errors.ends / ends)};
}

class SweptDrive : public testing::TestWithParam<bool> {};

TEST_P(SweptDrive, IsExactAndItsMapSharpOnlyIfCompensated) {
  const bool with_odometry = GetParam();
  const DriveErrors compensated = drive(true, with_odometry);
  EXPECT_LT(compensated.position, 0.1);
  EXPECT_LT(compensated.heading, degrees(0.5));
  EXPECT_LT(compensated.ends, 0.1);
  const DriveErrors at_once = drive(false, with_odometry);
  EXPECT_GT(at_once.position, 4.0 * compensated.position);
  EXPECT_GT(at_once.heading, 2.0 * compensated.heading);
  EXPECT_GT(at_once.ends, 4.0 * compensated.ends);
}

INSTANTIATE_TEST_SUITE_P(Odometry, SweptDrive, testing::Bool(),
                         [](const auto& with) { return with.param ? "AtTheFirstBeam" : "None"; });

}  // namespace
}  // namespace datmo::simulator::sweep_test
