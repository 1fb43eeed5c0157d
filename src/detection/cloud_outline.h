// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include "datmo_fusion/common/pose2.h"
#include "datmo_fusion/detection/object_classifier.h"
#include "datmo_fusion/sensor_model/road_plane.h"

namespace datmo {

/// Points with their times after the stamp (s) as intensity.
using TimedPoints = pcl::PointCloud<pcl::PointXYZI>;

/// One of the two ends of an outline, as the lidar sees it.
struct OutlineEnd {
  double gap = 0.0;     ///< m, to the next column at this range
  bool hidden = false;  ///< something nearer hides what is beyond
};

/// What a lidar sees of a cluster, from above.
struct CloudOutline {
  std::vector<Point2> points;  ///< m, base_link, the nearest of each column, by rising bearing
  OutlineEnd first;            ///< at the right
  OutlineEnd last;             ///< at the left
  double range = 0.0;          ///< m, mean, from the lidar
  double along = 0.0;          ///< m, from the nearest to the farthest of the points
  double top = 0.0;            ///< m above the ground
  double mean_time = 0.0;      ///< s after the stamp

  /// m, from its first to its last point or in depth, whichever is more.
  double size() const;

  /// `row_spacing`: rad; `cut`: its top is at the end of what is looked at.
  SeenSize seenSize(double row_spacing, bool cut) const;
};

/// All that a lidar sees by its columns: which of two things is before the other.
class CloudColumns {
 public:
  /// `points` (base_link, m) must outlive this; `lidar`: m; `spacing`: rad.
  CloudColumns(const TimedPoints& points, const Point2& lidar, double spacing);

  /// Of the points with these indices, one at least.
  CloudOutline outlineOf(const std::vector<int>& indices, const RoadPlane& ground) const;

 private:
  std::size_t columnOf(double bearing) const;

  /// `step`: to the columns beyond, 1 or -1.
  OutlineEnd endAt(const Point2& point, int step) const;

  const TimedPoints& points_;
  Point2 lidar_;
  double spacing_;
  std::vector<double> nearest_;  ///< m, by column
};

}  // namespace datmo
