// SPDX-License-Identifier: BSD-3-Clause
#include "street.h"

#include <algorithm>
#include <cmath>

#include "datmo_fusion/common/random.h"

namespace datmo {

namespace {

constexpr double kStreetPeriod = 0.06;  // s, of the demonstrator's scanner: 16.6 Hz
constexpr double kHalfFov = 80.0;       // degrees
constexpr double kRangeNoise = 0.05;
constexpr double kCars = 4.0;     // m, from the vehicle to the parked cars on both sides
constexpr double kHouses = 12.0;  // m, from the vehicle to the houses
constexpr double kCarLength = 4.5;
constexpr double kCarSpacing = 6.0;
constexpr double kFarthest = 50.0;

/// At 8 m/s the vehicle passes 24 parked cars in these, so that the first scan can follow the last.
constexpr int kScans = 300;

/// Returns whether there is a parked car at this distance along the street, or a gap.
bool isParked(double x) { return x - kCarSpacing * std::floor(x / kCarSpacing) < kCarLength; }

double rangeAlong(double direction, double x) {
  const double across = std::max(1e-9, std::abs(std::sin(direction)));
  const double to_cars = kCars / across;
  return isParked(x + to_cars * std::cos(direction)) ? to_cars : kHouses / across;
}

Scan scanAt(double x, int beams, Random& random) {
  Scan scan;
  scan.field.beam_spacing = degrees(2.0 * kHalfFov / (beams - 1));
  for (int beam = 0; beam < beams; ++beam) {
    Ray ray;
    ray.beam = static_cast<std::uint32_t>(beam);
    ray.bearing = degrees(-kHalfFov) + scan.field.beam_spacing * beam;
    const double range = rangeAlong(ray.bearing, x) + random.normal(kRangeNoise);
    ray.hit = range < kFarthest;
    ray.range = std::min(range, kFarthest);
    ray.end = ray.range * Point2(std::cos(ray.bearing), std::sin(ray.bearing));
    scan.rays.push_back(ray);
  }
  return scan;
}

}  // namespace

StreetDrive::StreetDrive(const StreetOptions& options) : speed_(options.speed) {
  Random random(1);
  for (int step = 0; step < kScans; ++step) {
    scans_.push_back(scanAt(speed_ * kStreetPeriod * step, options.beams, random));
  }
}

const Scan& StreetDrive::next() {
  ++step_;
  Scan& scan = scans_[step_ % scans_.size()];
  scan.stamp = Stamp::fromSeconds(1000.0 + kStreetPeriod * static_cast<double>(step_));
  return scan;
}

OdometrySample StreetDrive::odometry() const {
  return {scans_[step_ % scans_.size()].stamp, {speed_, 0.0}};
}

LabeledScan labeledScan(const Scan& scan, PointState state) {
  LabeledScan split;
  split.stamp = scan.stamp;
  split.scanner_in_base = scan.scanner_in_base;
  for (const Ray& ray : scan.rays) {
    if (ray.hit) {
      split.points.push_back({ray.end, ray.range, ray.bearing, ray.beam, state});
    }
  }
  return split;
}

}  // namespace datmo
