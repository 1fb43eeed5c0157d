// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/visibility/seen_points.h"

#include <algorithm>
#include <limits>

namespace datmo {

namespace {

/// Maximum number of scans, and of points per scan: more would look at the same positions again.
constexpr std::size_t kMaxScans = 6;
constexpr std::size_t kMaxPoints = 6;

/// m; closer points do not define the direction between them.
constexpr double kMinBaseline = 0.05;

/// Unit vector from a point's one neighbor to the other; zero: unknown.
Point2 directionAt(const std::vector<Point2>& points, std::size_t index) {
  const Point2& before = points[index > 0 ? index - 1 : 0];
  const Point2& after = points[std::min(index + 1, points.size() - 1)];
  const Point2 along = after - before;
  return along.norm() >= kMinBaseline ? Point2(along.normalized()) : Point2::Zero();
}

}  // namespace

void SeenPointHistory::add(const Object& object, double scan_time, double memory) {
  const std::size_t size = object.points.size();
  if (size == 0) {
    return;
  }
  const double time = scan_time + object.delay;
  SeenPoints seen{time, scan_time, size == 1, {}};
  const std::size_t taken = std::min(size, kMaxPoints);
  seen.points.reserve(taken);
  for (std::size_t i = 0; i < taken; ++i) {
    const std::size_t index = taken == 1 ? 0 : i * (size - 1) / (taken - 1);
    seen.points.push_back({object.points[index], directionAt(object.points, index)});
  }
  seen_.reserve(kMaxScans + 1);
  seen_.push_back(std::make_shared<const SeenPoints>(std::move(seen)));
  const auto recent = std::find_if(seen_.begin(), seen_.end(),
                                   [&](const auto& scan) { return scan->time >= time - memory; });
  seen_.erase(seen_.begin(), recent);
  if (seen_.size() > kMaxScans) {
    thinOut();
  }
}

/// Removes the scan whose removal leaves the smallest gap; the first and the last stay.
void SeenPointHistory::thinOut() {
  std::size_t crowded = 1;
  double min_gap = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i + 1 < seen_.size(); ++i) {
    const double gap = seen_[i + 1]->time - seen_[i - 1]->time;
    if (gap < min_gap) {
      min_gap = gap;
      crowded = i;
    }
  }
  seen_.erase(seen_.begin() + static_cast<std::ptrdiff_t>(crowded));
}

}  // namespace datmo
