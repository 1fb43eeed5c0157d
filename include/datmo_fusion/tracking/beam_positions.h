// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "datmo_fusion/common/stamp.h"
#include "datmo_fusion/visibility/scan_history.h"
#include "datmo_fusion/visibility/seen_points.h"

namespace datmo {

/// Positions of a target at which beams of the same scan ended: only for these can beams be
/// evaluated. Points from a camera are less exact than the tolerance of a beam.
class BeamPositions {
 public:
  struct OfScan {
    std::size_t back = 0;  ///< index of the scan in the history
    SeenPoints points;     ///< at least one
  };

  /// `seen`: with times on a clock (s) that shows `clock` at the stamp `now`.
  BeamPositions(const ScanHistory& history, const SeenPointHistory& seen, Stamp now, double clock);

  /// Returns the scans, oldest first.
  const std::vector<OfScan>& scans() const { return scans_; }

  /// Returns whether, as far as is known, no beam ended on the target: there are no scans, its
  /// objects have no points, or these are not from its scans. False if its scans were dropped.
  bool areOfOthers() const { return scans_.empty() && known_; }

  /// Returns whether it was seen only by one beam, the same in all scans.
  bool keepsItsBeam() const { return keeps_beam_; }

 private:
  std::vector<OfScan> scans_;
  bool known_ = false;
  bool keeps_beam_ = false;
};

}  // namespace datmo
