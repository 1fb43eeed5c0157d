// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "datmo_fusion/fusion/object/object_fuser.h"
#include "datmo_fusion/visibility/scan_support.h"
#include "datmo_fusion/visibility/visibility.h"

namespace datmo {

/// One source's objects, brought to where the vehicle was at the reference's stamp.
struct ObjectIntake {
  ObjectList list;  ///< valid objects, in an order of their own, and views; reference's stamp
  std::vector<PositionEvidence>
      scan_evidence;                     ///< of the scan, of each; of the scanner's own: none
  Point2 sensor = Point2::Zero();        ///< m, from where it looks
  std::optional<Visibility> visibility;  ///< of all its views; none: not known
};

/// @param scan_support null: nothing is known of what the scanner saw
/// @param counts of what is left out, added to
ObjectIntake ingest(const SourceObjects& source, Stamp reference, const ScanSupport* scan_support,
                    const ObjectFuserOptions& options, ObjectFusionCounts& counts);

/// Unless it was seen to move.
void takeForStanding(Object& object);

}  // namespace datmo
