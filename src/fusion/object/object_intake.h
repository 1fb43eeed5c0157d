// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "datmo_fusion/fusion/object/object_fuser.h"
#include "datmo_fusion/visibility/scan_support.h"
#include "datmo_fusion/visibility/visibility.h"

namespace datmo {

/// One source's objects, moved to the vehicle's pose at the reference's stamp.
struct ObjectIntake {
  ObjectList list;  ///< valid objects in a canonical order, and views; reference's stamp
  std::vector<PositionEvidence>
      scan_evidence;                     ///< of the scan, of each; of the scanner's own: none
  Point2 sensor = Point2::Zero();        ///< m, sensor position
  std::optional<Visibility> visibility;  ///< from all its views; none: unknown
};

/// @param scan_support null: nothing is known about the scanner's view
/// @param counts rejected objects are added to these
ObjectIntake ingest(const SourceObjects& source, Stamp reference, const ScanSupport* scan_support,
                    const ObjectFuserOptions& options, ObjectFusionCounts& counts);

/// Sets an object to static unless it was seen to move.
void treatAsStanding(Object& object);

}  // namespace datmo
