// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <utility>
#include <vector>

#include "datmo_fusion/common/pose2.h"
#include "datmo_fusion/common/scan.h"
#include "datmo_fusion/grid/occupancy_map.h"
#include "datmo_fusion/slam/end_points.h"

namespace datmo {

/// Adds a scan without moving objects to a map.
void addStatic(OccupancyMap& map, const Scan& scan, const Pose2& base_in_map);

/// Part of a drive: some of its scans, in the frame of one of them. A map is made from it on
/// demand: the scans take a hundredth of its memory.
class Submap {
 public:
  /// Adds a scan, in ascending stamp order. `pose`: of the vehicle in the submap's frame.
  void add(Scan scan, const Pose2& pose) { scans_.push_back({std::move(scan), pose}); }

  bool empty() const { return scans_.empty(); }

  /// Returns the maximum distance of the vehicle from the frame's origin, m.
  double radius() const;

  /// Returns its map up to `reach` (m) from the vehicle's positions; the window given in the
  /// options is ignored. Throws OptionError.
  OccupancyMap map(OccupancyMapOptions options, double reach) const;

  /// Returns the ends of all beams, as samples of surfaces (endPoints), in the submap's frame.
  std::vector<EndPoint> ends(double max_step) const;

 private:
  struct PosedScan {
    Scan scan;
    Pose2 pose;
  };

  std::vector<PosedScan> scans_;
};

}  // namespace datmo
