// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/slam/submap.h"

#include <algorithm>

namespace datmo {

void addStatic(OccupancyMap& map, const Scan& scan, const Pose2& base_in_map) {
  map.update(scan, std::vector<PointState>(scan.rays.size(), PointState::kStatic), base_in_map);
}

double Submap::radius() const {
  double radius = 0.0;
  for (const PosedScan& posed : scans_) {
    radius = std::max(radius, posed.pose.position().norm());
  }
  return radius;
}

OccupancyMap Submap::map(OccupancyMapOptions options, double reach) const {
  options.window.length = options.window.width = 2.0 * (radius() + reach);
  OccupancyMap map(options);
  for (const PosedScan& posed : scans_) {
    addStatic(map, posed.scan, posed.pose);
  }
  return map;
}

std::vector<EndPoint> Submap::ends(double max_step) const {
  std::vector<EndPoint> all;
  for (const PosedScan& posed : scans_) {
    const Eigen::Matrix2d rotation = posed.pose.rotation();
    for (const EndPoint& end : endPoints(posed.scan, max_step)) {
      all.push_back({posed.pose * end.position, rotation * end.sampling * rotation.transpose()});
    }
  }
  return all;
}

}  // namespace datmo
