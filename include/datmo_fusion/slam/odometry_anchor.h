// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "datmo_fusion/slam/odometry_buffer.h"
#include "datmo_fusion/slam/pose_filter.h"

namespace datmo {

/// Keeps the pose at the scan nearest to the last odometry pose, in case its messages stop.
///
/// An encoder keeps counting while its messages are lost. When they resume, the difference of its
/// poses shows where the vehicle is, whatever the scans in between were matched to: if those
/// contradict it, they were matched wrongly.
class OdometryAnchor {
 public:
  /// `pose`: the filter after a scan of this stamp; in ascending stamp order.
  void keep(Stamp stamp, const PoseFilter& pose, const OdometryBuffer& odometry);

  /// Returns the kept pose, moved to the stamp of a scan by odometry poses that have just resumed,
  /// if it contradicts `predicted`, the prediction for the same scan after the matches in between.
  std::optional<PoseFilter> correction(Stamp stamp, const PoseFilter& predicted,
                                       const OdometryBuffer& odometry) const;

 private:
  struct Anchor {
    Stamp stamp;      ///< of the scan
    Stamp last_pose;  ///< the newest odometry pose at that time
    PoseFilter pose;
  };

  std::optional<Anchor> anchor_;
};

}  // namespace datmo
