// SPDX-License-Identifier: BSD-3-Clause
#include "cloud_outline.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "datmo_fusion/common/angle.h"

namespace datmo {

namespace {

/// m; points next to an end that are nearer by this hide what is beyond.
constexpr double kBefore = 0.3;

/// Columns next to an end that are checked: at close range voxels are as wide as several columns.
constexpr int kBeside = 3;

double bearingOf(const Point2& from_lidar) { return std::atan2(from_lidar.y(), from_lidar.x()); }

}  // namespace

double CloudOutline::size() const {
  return std::max((points.back() - points.front()).norm(), along);
}

SeenSize CloudOutline::seenSize(double row_spacing, bool cut) const {
  SeenSize seen;
  seen.height = top;
  seen.height_sigma = row_spacing * range;
  seen.higher = cut;
  seen.across = (points.back() - points.front()).norm();
  seen.across_sigma = std::hypot(first.gap, last.gap);
  seen.along = along;
  seen.along_sigma = seen.across_sigma;
  seen.wider = first.hidden || last.hidden;
  return seen;
}

CloudColumns::CloudColumns(const TimedPoints& points, const Point2& lidar, double spacing)
    : points_(points),
      lidar_(lidar),
      spacing_(spacing),
      nearest_(static_cast<std::size_t>(std::ceil(2.0 * kPi / spacing)) + 1,
               std::numeric_limits<double>::infinity()) {
  for (const pcl::PointXYZI& point : points) {
    const Point2 from_lidar = Point2(point.x, point.y) - lidar_;
    double& nearest = nearest_[columnOf(bearingOf(from_lidar))];
    nearest = std::min(nearest, from_lidar.norm());
  }
}

std::size_t CloudColumns::columnOf(double bearing) const {
  return static_cast<std::size_t>((normalizeAngle(bearing) + kPi) / spacing_);
}

OutlineEnd CloudColumns::endAt(const Point2& point, int step) const {
  const Point2 from_lidar = point - lidar_;
  const double range = from_lidar.norm();
  OutlineEnd end{spacing_ * range, false};
  for (int i = 1; i <= kBeside; ++i) {
    const double beside = bearingOf(from_lidar) + step * i * spacing_;
    end.hidden = end.hidden || nearest_[columnOf(beside)] < range - kBefore;
  }
  return end;
}

CloudOutline CloudColumns::outlineOf(const std::vector<int>& indices,
                                     const RoadPlane& ground) const {
  const auto at = [this](int index) -> const pcl::PointXYZI& {
    return points_[static_cast<std::size_t>(index)];
  };
  const pcl::PointXYZI& any = at(indices.front());
  const double middle = bearingOf(Point2(any.x, any.y) - lidar_);
  // By columns relative to that of any point, so that clusters behind the lidar are not split.
  std::map<long, Point2> nearest;
  CloudOutline outline;
  for (const int index : indices) {
    const pcl::PointXYZI& point = at(index);
    const Point2 from_lidar = Point2(point.x, point.y) - lidar_;
    const double bearing = normalizeAngle(bearingOf(from_lidar) - middle);
    const auto [column, is_new] = nearest.try_emplace(std::lround(bearing / spacing_), from_lidar);
    if (!is_new && from_lidar.norm() < column->second.norm()) {
      column->second = from_lidar;
    }
    outline.top = std::max(outline.top, ground.heightOf(point.getVector3fMap().cast<double>()));
    outline.mean_time += static_cast<double>(point.intensity);
  }
  outline.mean_time /= static_cast<double>(indices.size());
  double shortest = std::numeric_limits<double>::infinity();
  double longest = 0.0;
  for (const auto& [column, from_lidar] : nearest) {
    const double range = from_lidar.norm();
    shortest = std::min(shortest, range);
    longest = std::max(longest, range);
    outline.range += range / static_cast<double>(nearest.size());
    outline.points.push_back(lidar_ + from_lidar);
  }
  outline.along = longest - shortest;
  outline.first = endAt(outline.points.front(), -1);
  outline.last = endAt(outline.points.back(), 1);
  return outline;
}

}  // namespace datmo
