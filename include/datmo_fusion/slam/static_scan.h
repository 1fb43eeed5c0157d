// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "datmo_fusion/common/scan.h"

namespace datmo {

/// m; how far a beam without return is known to be free, or the scanner's range if that is nearer
/// or not known: farther, staticRanges has nothing.
double staticRange(const ScanField& field);

/// Ranges of what stands still, one for each beam of the field, m, as a navigation stack marks and
/// clears by them (REP 117): the range of the nearest end point that stands, within staticRange();
/// +infinity for a beam without return that is known to be free up to there; NaN, which neither
/// marks nor clears, for a beam that ends on something moving, that has no valid measurement, or of
/// whose way nothing is known.
///
/// `include_unknown`: end points where the map knows nothing yet count as standing. Empty without
/// beams in the field; end points of beams beyond the field are left out.
std::vector<float> staticRanges(const LabeledScan& scan, bool include_unknown);

/// The end points that stand, m, frame of the scan; with `include_unknown` as above.
std::vector<Point2> staticPoints(const LabeledScan& scan, bool include_unknown);

}  // namespace datmo
