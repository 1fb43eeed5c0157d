// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/slam/keyframe.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace datmo {

namespace {

constexpr double kStep = 0.005;  // m

/// m; limit of what 16 bits of steps can hold.
constexpr double kMaxStored = 160.0;
static_assert(kMaxStored / kStep < std::numeric_limits<std::int16_t>::max());

std::int16_t inSteps(double meters) {
  return static_cast<std::int16_t>(std::lround(meters / kStep));
}

}  // namespace

KeptScan::KeptScan(const LabeledScan& scan)
    : scanner_in_base_(scan.scanner_in_base), field_(scan.field) {
  std::vector<bool> is_free(field_.free_range > 0.0 ? field_.beams : 0, true);
  const auto not_free = [&is_free](std::uint32_t beam) {
    if (beam < is_free.size()) {
      is_free[beam] = false;
    }
  };
  std::for_each(scan.blind_beams.begin(), scan.blind_beams.end(), not_free);
  for (const ScanPoint& point : scan.points) {
    not_free(point.beam);
    if (point.state != PointState::kMoving && point.position.cwiseAbs().maxCoeff() <= kMaxStored) {
      ends_.push_back({inSteps(point.position.x()), inSteps(point.position.y())});
    }
  }
  for (std::size_t beam = 0; beam < is_free.size(); ++beam) {
    if (is_free[beam]) {
      free_beams_.push_back(static_cast<std::uint16_t>(beam));
    }
  }
  ends_.shrink_to_fit();
  free_beams_.shrink_to_fit();
}

Scan KeptScan::scan(Stamp stamp) const {
  Scan scan;
  scan.stamp = stamp;
  scan.scanner_in_base = scanner_in_base_;
  scan.field = field_;
  scan.rays.reserve(ends_.size() + free_beams_.size());
  Ray ray;
  ray.origin = scanner_in_base_.position();
  ray.hit = true;
  for (const End& end : ends_) {
    ray.end = kStep * Point2(end.x, end.y);
    ray.range = (ray.end - ray.origin).norm();
    scan.rays.push_back(ray);
  }
  ray.hit = false;
  ray.range = field_.free_range;
  for (const std::uint16_t beam : free_beams_) {
    const double bearing = field_.first_bearing + field_.beam_spacing * beam;
    ray.end =
        scanner_in_base_ * Point2(ray.range * std::cos(bearing), ray.range * std::sin(bearing));
    scan.rays.push_back(ray);
  }
  return scan;
}

}  // namespace datmo
