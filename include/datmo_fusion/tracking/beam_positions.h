// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "datmo_fusion/common/stamp.h"
#include "datmo_fusion/visibility/scan_history.h"
#include "datmo_fusion/visibility/seen_points.h"

namespace datmo {

/// Of where a target was seen the points at which beams of the very scan ended: beams can be asked
/// of these alone. A camera's points are less exact than the tolerance of a beam.
class BeamPositions {
 public:
  struct OfScan {
    std::size_t back = 0;  ///< which scan, in the history
    SeenPoints points;     ///< one at least
  };

  /// `seen` on a clock (s) that shows `clock` at the stamp `now`.
  BeamPositions(const ScanHistory& history, const SeenPointHistory& seen, Stamp now, double clock);

  /// Oldest first.
  const std::vector<OfScan>& scans() const { return scans_; }

  /// Whether no beam ended on the target, by all that is known: there are no scans, its objects
  /// have no points, or they are none of its scans'. False where its scans are forgotten.
  bool areOfOthers() const { return scans_.empty() && known_; }

  /// Whether it was seen by a single beam, and always by the same one.
  bool keepsItsBeam() const { return keeps_beam_; }

 private:
  std::vector<OfScan> scans_;
  bool known_ = false;
  bool keeps_beam_ = false;
};

}  // namespace datmo
