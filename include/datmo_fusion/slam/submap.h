// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <utility>
#include <vector>

#include "datmo_fusion/common/pose2.h"
#include "datmo_fusion/common/scan.h"
#include "datmo_fusion/grid/occupancy_map.h"
#include "datmo_fusion/slam/end_points.h"

namespace datmo {

/// Takes a scan in which nothing moves into a map.
void addStatic(OccupancyMap& map, const Scan& scan, const Pose2& base_in_map);

/// Part of a drive: a few of its scans, in the frame of one of them. A map is made of it when one
/// is needed: the scans take a hundredth of its memory.
class Submap {
 public:
  /// By rising stamps. `pose`: of the vehicle in the submap's frame.
  void add(Scan scan, const Pose2& pose) { scans_.push_back({std::move(scan), pose}); }

  bool empty() const { return scans_.empty(); }

  /// m; the farthest that the vehicle was from the frame's origin.
  double radius() const;

  /// The map of it up to `reach` (m) from where the vehicle was; the window that the options say is
  /// not read. Throws OptionError.
  OccupancyMap map(OccupancyMapOptions options, double reach) const;

  /// The ends of all beams, as samples of surfaces (endPoints), in the submap's frame.
  std::vector<EndPoint> ends(double max_step) const;

 private:
  struct PosedScan {
    Scan scan;
    Pose2 pose;
  };

  std::vector<PosedScan> scans_;
};

}  // namespace datmo
