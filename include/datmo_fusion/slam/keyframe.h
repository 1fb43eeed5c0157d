// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "datmo_fusion/common/pose2.h"
#include "datmo_fusion/common/scan.h"

namespace datmo {

/// The static points and free beams of a scan, kept after it has left the live map: four bytes per
/// end point, with a resolution of 5 mm, and two per beam without return.
///
/// Beams that end on moving objects are left out, as are end points beyond 160 m in x or y.
class KeptScan {
 public:
  /// Without beams.
  KeptScan() = default;
  explicit KeptScan(const LabeledScan& scan);

  bool empty() const { return ends_.empty() && free_beams_.empty(); }

  /// Memory used by the beams.
  std::size_t bytes() const {
    return ends_.size() * sizeof(End) + free_beams_.size() * sizeof(std::uint16_t);
  }

  /// Returns the scan of these beams, in the vehicle's frame.
  Scan scan(Stamp stamp) const;

 private:
  /// In steps of the resolution, from the vehicle.
  struct End {
    std::int16_t x;
    std::int16_t y;
  };

  Pose2 scanner_in_base_;
  ScanField field_;
  std::vector<End> ends_;  ///< by ascending beam index
  std::vector<std::uint16_t> free_beams_;
};

/// A pose of the vehicle and its stamp.
struct StampedPose {
  Stamp stamp;
  Pose2 pose;
};

/// A scan from which submaps are made, and its pose in the live SLAM.
struct Keyframe {
  Stamp stamp;
  PoseWithCovariance base_in_map;
  KeptScan scan;
};

}  // namespace datmo
