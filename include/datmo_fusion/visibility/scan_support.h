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

/// Evidence of a scan at the position of an object, as shares of the beams toward it. The
/// remaining beams are occluded, blind, outside the field, or end there on something not static.
struct PositionEvidence {
  double static_share = 0.0;   ///< end there on known static obstacles
  double through_share = 0.0;  ///< pass through all of the object's position
  double beams = 0.0;          ///< expected on an object of this width, at least 0

  /// Returns how many of them do not end on something that may move there.
  double beamsElsewhere() const { return beams * (static_share + through_share); }
};

/// Evidence of a labeled planar scan on objects that another sensor reports, and the scanner does
/// not. Vehicle's frame (base_link) at the scan's stamp.
///
/// The other sensor's position is uncertain, in range more than laterally. A point lies on the
/// object if its distance from the box is at most the standard deviation of the position in that
/// direction, even if a side is seen at a grazing angle; a beam passes through the object if it
/// ends clearly behind the far side; a beam that ends before both is occluded, and carries no
/// information on what is behind.
class ScanSupport {
 public:
  /// Throws OptionError.
  ScanSupport(const LabeledScan& scan, const Checked<ScanSupportOptions>& options);

  /// `motion_std`: m, how far the object may have moved since it was seen, at least 0.
  PositionEvidence evidence(const Object& object, double motion_std) const;

  /// Returns whether enough beams at its position end on static points.
  bool standsStill(const PositionEvidence& evidence) const {
    return evidence.static_share >= options_.static_share;
  }

 private:
  enum class End { kNothing, kHit, kStaticHit };
  struct Beam {
    End end = End::kNothing;
    double range = 0.0;  ///< m, seen up to here; 0 if blind
  };

  /// The beam nearest to this fractional index (BeamFan); none outside the field.
  const Beam* beam(double position) const;

  ScanSupportOptions options_;
  Pose2 scanner_in_base_;
  ScanField field_;
  BeamFan fan_;
  std::vector<Beam> beams_;
};

}  // namespace datmo
