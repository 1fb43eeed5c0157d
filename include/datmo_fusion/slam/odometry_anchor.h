// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "datmo_fusion/slam/odometry_buffer.h"
#include "datmo_fusion/slam/pose_filter.h"

namespace datmo {

/// The pose at the scan nearest to the last pose of the odometry, for when its messages stop.
///
/// An encoder goes on counting while its messages are lost. When they come again, the difference of
/// its poses shows where the vehicle is, whatever the scans in between were taken for: if those
/// contradict it, they were matched wrongly.
class OdometryAnchor {
 public:
  /// `pose`: the filter after a scan of this stamp; by rising stamp.
  void keep(Stamp stamp, const PoseFilter& pose, const OdometryBuffer& odometry);

  /// The kept pose moved to the stamp of a scan by the poses of odometry that was silent until now,
  /// if it contradicts `predicted`, the same scan's prediction after the matches in between.
  std::optional<PoseFilter> correction(Stamp stamp, const PoseFilter& predicted,
                                       const OdometryBuffer& odometry) const;

 private:
  struct Anchor {
    Stamp stamp;      ///< of the scan
    Stamp last_pose;  ///< of the odometry, then
    PoseFilter pose;
  };

  std::optional<Anchor> anchor_;
};

}  // namespace datmo
