// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "datmo_fusion/common/pose2.h"
#include "datmo_fusion/common/scan.h"
#include "datmo_fusion/common/stamp.h"
#include "datmo_fusion/common/twist2.h"

namespace datmo {

/// Time from a scan's stamp to its last ray, s, 0 or more; 0 for a scan without rays.
double sweepDuration(const Scan& scan);

/// The scan as it would have been measured at once, at its stamp: each ray (origin, end, bearing)
/// is brought from the vehicle's frame at the ray's own time into its frame at the scan's stamp,
/// for a vehicle that moves with this twist all the while. The rays' times become 0; ranges stay.
/// The thesis takes all beams as measured at once; at 14 m/s those of a scanner that takes 27 ms
/// for its field of view are up to 0.4 m off then.
///
/// What moves by itself is seen at its ray's own time and stays where it was then.
Scan compensateMotion(Scan scan, const Twist2& twist);

/// A scan that is compensated, as the vehicle would have measured it at another time. `base`: of
/// the vehicle at the scan's stamp, in its frame at `stamp`. What moves by itself stays where it
/// was.
Scan scanAt(Scan scan, Stamp stamp, const Pose2& base);

}  // namespace datmo
