// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "datmo_fusion/common/object.h"
#include "datmo_fusion/common/options.h"
#include "datmo_fusion/common/scan.h"
#include "datmo_fusion/visibility/beam_fan.h"

namespace datmo {

struct ScanSupportOptions {
  double static_share = 0.6;      ///< 0 to 1
  double max_static_reach = 2.0;  ///< m

  void visit(OptionVisitor& visitor);
};

/// Evidence of a scan at the position of an object, as shares of the beams toward it. The rest is
/// hidden by what is nearer, blind, outside the field, or ends there on what is not static.
struct PositionEvidence {
  double static_share = 0.0;   ///< end there on what the map knows as static
  double through_share = 0.0;  ///< pass through the whole object's position
  double beams = 0.0;          ///< expected on an object of this width, at least 0

  /// How many of them do not end on something that may move there.
  double beamsElsewhere() const { return beams * (static_share + through_share); }
};

/// Evidence of a labeled planar scan on objects that the scanner's list does not
/// contain, but another sensor's. Vehicle's frame (base_link) at the scan's stamp.
///
/// The other sensor's position of the object is uncertain, in range more than across. A
/// point lies on it if it is no farther from its box than the standard deviation of the position in
/// that direction, also where a side is seen at a flat angle; a beam passes through it if it ends
/// clearly behind the far side; one that ends before both is hidden, and says nothing of what is
/// behind.
class ScanSupport {
 public:
  /// Throws OptionError.
  ScanSupport(const LabeledScan& scan, const Checked<ScanSupportOptions>& options);

  /// `motion_std`: m, how far the object may have moved by itself since it was seen, at least 0.
  PositionEvidence evidence(const Object& object, double motion_std) const;

  /// Whether the beams at its position end on static points.
  bool standsStill(const PositionEvidence& evidence) const {
    return evidence.static_share >= options_.static_share;
  }

 private:
  enum class End { kNothing, kHit, kStaticHit };
  struct Beam {
    End end = End::kNothing;
    double range = 0.0;  ///< m, seen up to here; blind: 0
  };

  /// The beam nearest to this position (BeamFan); none outside the field.
  const Beam* beam(double position) const;

  ScanSupportOptions options_;
  Pose2 scanner_in_base_;
  ScanField field_;
  BeamFan fan_;
  std::vector<Beam> beams_;
};

}  // namespace datmo
