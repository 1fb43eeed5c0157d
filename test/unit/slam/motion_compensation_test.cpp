// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/slam/motion_compensation.h"

#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

namespace datmo::motion_compensation_test {
namespace {

/// Of the room around the origin in which the vehicle drives, m.
constexpr double kHalfLength = 30.0;
constexpr double kHalfWidth = 12.0;

/// Returns the distance from a point in the room to its walls.
double rangeToWall(const Point2& from, double direction) {
  const double c = std::cos(direction);
  const double s = std::sin(direction);
  const double along = (std::copysign(kHalfLength, c) - from.x()) / c;
  const double across = (std::copysign(kHalfWidth, s) - from.y()) / s;
  return std::min(along, across);
}

double distanceToWall(const Point2& point) {
  return std::min(std::abs(std::abs(point.x()) - kHalfLength),
                  std::abs(std::abs(point.y()) - kHalfWidth));
}

/// How a scanner sweeps its field of view, and how the vehicle moves meanwhile.
struct Sweep {
  const char* name;
  double step;      ///< deg from beam to beam, negative: to the right
  double duration;  ///< s
  Twist2 twist;
};

constexpr int kBeams = 81;
const Pose2 kBaseInRoom(-4.0, 1.0, 0.4);

/// Each ray is measured from the vehicle's position at the ray's time.
Scan sweptScan(const Sweep& sweep) {
  Scan scan;
  scan.scanner_in_base = Pose2(3.6, 0.3, 0.1);
  scan.field.first_bearing = degrees(-0.5 * sweep.step * (kBeams - 1));
  scan.field.beam_spacing = degrees(sweep.step);
  scan.field.beams = kBeams;
  for (std::uint32_t beam = 0; beam < kBeams; ++beam) {
    Ray ray;
    ray.beam = beam;
    ray.time = sweep.duration * beam / (kBeams - 1);
    ray.bearing = degrees(sweep.step * (beam - 0.5 * (kBeams - 1)));
    const Pose2 scanner = kBaseInRoom * arc(sweep.twist, ray.time) * scan.scanner_in_base;
    ray.range = rangeToWall(scanner.position(), scanner.heading() + ray.bearing);
    ray.hit = true;
    ray.origin = scan.scanner_in_base.position();
    ray.end = scan.scanner_in_base *
              Point2(ray.range * std::cos(ray.bearing), ray.range * std::sin(ray.bearing));
    scan.rays.push_back(ray);
  }
  return scan;
}

/// Returns the distance of the rays' ends, seen from the pose at the scan's stamp, from the walls.
double largestDistanceToWalls(const Scan& scan) {
  double largest = 0.0;
  for (const Ray& ray : scan.rays) {
    largest = std::max(largest, distanceToWall(kBaseInRoom * ray.end));
  }
  return largest;
}

class MotionCompensation : public testing::TestWithParam<Sweep> {};

TEST_P(MotionCompensation, PutsTheEndsOnTheWalls) {
  const Scan scan = sweptScan(GetParam());
  EXPECT_GT(largestDistanceToWalls(scan), 0.1);
  EXPECT_LT(largestDistanceToWalls(compensateMotion(scan, GetParam().twist)), 1e-9);
}

TEST_P(MotionCompensation, PutsTheOriginsWhereTheScannerWas) {
  const Scan scan = sweptScan(GetParam());
  const Scan at_once = compensateMotion(scan, GetParam().twist);
  const Pose2 last = arc(GetParam().twist, GetParam().duration) * scan.scanner_in_base;
  EXPECT_EQ(at_once.rays.front().origin, scan.rays.front().origin);
  EXPECT_TRUE(at_once.rays.back().origin.isApprox(last.position(), 1e-12));
}

TEST_P(MotionCompensation, KeepsRaysWhole) {
  const Scan scan = sweptScan(GetParam());
  const Scan at_once = compensateMotion(scan, GetParam().twist);
  ASSERT_EQ(at_once.rays.size(), scan.rays.size());
  for (std::size_t i = 0; i < scan.rays.size(); ++i) {
    const Ray& ray = at_once.rays[i];
    const double direction = at_once.scanner_in_base.heading() + ray.bearing;
    const Point2 along(std::cos(direction), std::sin(direction));
    EXPECT_NEAR((ray.end - ray.origin - ray.range * along).norm(), 0.0, 1e-9);
    EXPECT_EQ(ray.range, scan.rays[i].range);
    EXPECT_EQ(ray.beam, scan.rays[i].beam);
    EXPECT_EQ(ray.time, 0.0);
  }
}

TEST_P(MotionCompensation, TheFieldHasTheCurrentBearings) {
  const Scan at_once = compensateMotion(sweptScan(GetParam()), GetParam().twist);
  for (const Ray& ray : at_once.rays) {
    const double expected = at_once.field.first_bearing + at_once.field.beam_spacing * ray.beam;
    EXPECT_NEAR(angleBetween(expected, ray.bearing), 0.0, 1e-9);
  }
}

INSTANTIATE_TEST_SUITE_P(Sweeps, MotionCompensation,
                         testing::Values(Sweep{"ToTheLeft", 2.0, 0.0268, {14.0, 0.0}},
                                         Sweep{"ToTheRight", -2.0, 0.0444, {14.0, 0.3}},
                                         Sweep{"TurningOnTheSpot", 2.0, 0.1, {0.0, 1.5}},
                                         Sweep{"TurningAgainstTheBeams", -4.0, 0.1, {5.0, 1.5}},
                                         Sweep{"Backward", 2.0, 0.1, {-3.0, -0.8}}),
                         [](const auto& sweep) { return std::string(sweep.param.name); });

TEST(MotionCompensationOf, RaysWithoutTimesChangesNothing) {
  const Scan scan = sweptScan({"", 2.0, 0.0, {14.0, 1.0}});
  EXPECT_EQ(sweepDuration(scan), 0.0);
  const Scan same = compensateMotion(scan, {14.0, 1.0});
  for (std::size_t i = 0; i < scan.rays.size(); ++i) {
    EXPECT_EQ(same.rays[i].end, scan.rays[i].end);
    EXPECT_EQ(same.rays[i].origin, scan.rays[i].origin);
    EXPECT_EQ(same.rays[i].bearing, scan.rays[i].bearing);
  }
}

TEST(MotionCompensationOf, AVehicleAtRestChangesNothing) {
  const Scan scan = sweptScan({"", 2.0, 0.1, {}});
  const Scan same = compensateMotion(scan, {});
  for (std::size_t i = 0; i < scan.rays.size(); ++i) {
    EXPECT_TRUE(same.rays[i].end.isApprox(scan.rays[i].end, 1e-12));
  }
}

TEST(MotionCompensationOf, NoRaysIsInstantaneous) {
  EXPECT_EQ(sweepDuration({}), 0.0);
  EXPECT_TRUE(compensateMotion({}, {14.0, 0.0}).rays.empty());
}

TEST(MotionCompensationOf, TheSweepLastsToItsLatestRay) {
  Scan scan = sweptScan({"", 2.0, 0.08, {}});
  EXPECT_DOUBLE_EQ(sweepDuration(scan), 0.08);
  scan.rays.pop_back();
  EXPECT_DOUBLE_EQ(sweepDuration(scan), 0.079);
}

TEST(ScanAt, CompensationToAnotherTimeEqualsAMeasurementThen) {
  const Scan scan = sweptScan({"", 0.0, 0.0, {}});
  const Pose2 base(-1.0, 0.5, 0.1);  // the vehicle has driven on
  const Stamp later = scan.stamp + 0.1;
  const Scan moved = scanAt(scan, later, base);
  EXPECT_EQ(moved.stamp, later);
  ASSERT_EQ(moved.rays.size(), scan.rays.size());
  for (std::size_t i = 0; i < scan.rays.size(); ++i) {
    EXPECT_TRUE(moved.rays[i].end.isApprox(base * scan.rays[i].end, 1e-12));
    EXPECT_TRUE(moved.rays[i].origin.isApprox(base * scan.rays[i].origin, 1e-12));
    EXPECT_EQ(moved.rays[i].bearing, scan.rays[i].bearing) << "about the scanner";
  }
  const Pose2 scanner = base * scan.scanner_in_base;
  EXPECT_TRUE(moved.scanner_in_base.position().isApprox(scanner.position(), 1e-12));
}

}  // namespace
}  // namespace datmo::motion_compensation_test
