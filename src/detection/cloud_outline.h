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

/// One of the two ends of an outline, as seen by the lidar.
struct OutlineEnd {
  double gap = 0.0;     ///< m, to the next column at this range
  bool hidden = false;  ///< something nearer hides what is beyond
};

/// The visible outline of a cluster, from above.
struct CloudOutline {
  std::vector<Point2> points;  ///< m, base_link, the nearest of each column, by ascending bearing
  OutlineEnd first;            ///< right end
  OutlineEnd last;             ///< left end
  double range = 0.0;          ///< m, mean, from the lidar
  double along = 0.0;          ///< m, from the nearest to the farthest of the points
  double top = 0.0;            ///< m above the ground
  double mean_time = 0.0;      ///< s after the stamp

  /// Returns the larger one of the distance from first to last point and the extent in depth, m.
  double size() const;

  /// `row_spacing`: rad; `cut`: its top is at the upper limit of the height band.
  SeenSize seenSize(double row_spacing, bool cut) const;
};

/// All points of a lidar by columns, to determine which of two objects is in front.
class CloudColumns {
 public:
  /// `points` (base_link, m) must outlive this; `lidar`: m; `spacing`: rad.
  CloudColumns(const TimedPoints& points, const Point2& lidar, double spacing);

  /// Returns the outline of the points with these indices, at least one.
  CloudOutline outlineOf(const std::vector<int>& indices, const RoadPlane& ground) const;

 private:
  std::size_t columnOf(double bearing) const;

  /// `step`: direction of the neighboring columns, 1 or -1.
  OutlineEnd endAt(const Point2& point, int step) const;

  const TimedPoints& points_;
  Point2 lidar_;
  double spacing_;
  std::vector<double> nearest_;  ///< m, by column
};

}  // namespace datmo
