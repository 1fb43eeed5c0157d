// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "datmo_fusion/common/pose2.h"
#include "datmo_fusion/common/scan.h"

namespace datmo {

/// What stood still in a scan and what was free, for the time after it has left the live map: four
/// bytes for each end point, to within 5 mm, and two for each beam without return.
///
/// Beams that end on something moving are left out, and end points farther than 160 m in x or y.
class KeptScan {
 public:
  /// Without beams.
  KeptScan() = default;
  explicit KeptScan(const LabeledScan& scan);

  bool empty() const { return ends_.empty() && free_beams_.empty(); }

  /// That the beams take.
  std::size_t bytes() const {
    return ends_.size() * sizeof(End) + free_beams_.size() * sizeof(std::uint16_t);
  }

  /// The scan of these beams, in the vehicle's frame.
  Scan scan(Stamp stamp) const;

 private:
  /// In steps from the vehicle.
  struct End {
    std::int16_t x;
    std::int16_t y;
  };

  Pose2 scanner_in_base_;
  ScanField field_;
  std::vector<End> ends_;  ///< by rising beam index
  std::vector<std::uint16_t> free_beams_;
};

/// A pose of the vehicle at a time.
struct StampedPose {
  Stamp stamp;
  Pose2 pose;
};

/// A scan of a drive from which submaps are made, and the pose that the live SLAM gave it.
struct Keyframe {
  Stamp stamp;
  PoseWithCovariance base_in_map;
  KeptScan scan;
};

}  // namespace datmo
