// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "datmo_fusion/common/scan.h"

namespace datmo {

/// Returns how far a beam without return is known to be free, m, or the scanner's range if that is
/// shorter or the former is unknown; staticRanges has nothing beyond.
double staticRange(const ScanField& field);

/// Returns the ranges of static obstacles, one per beam of the field, m, as a navigation stack uses
/// them for marking and clearing (REP 117): the range of the nearest static end point within
/// staticRange(); +infinity for a beam without return that is known to be free up to there; NaN,
/// which neither marks nor clears, for a beam that ends on a moving object, has no valid
/// measurement, or along which nothing is known.
///
/// `include_unknown`: end points where the map knows nothing yet count as static. Empty without
/// beams in the field; end points of beams beyond the field are ignored.
std::vector<float> staticRanges(const LabeledScan& scan, bool include_unknown);

/// Returns the static end points, m, in the scan's frame; `include_unknown` as above.
std::vector<Point2> staticPoints(const LabeledScan& scan, bool include_unknown);

}  // namespace datmo
