// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "datmo_fusion/common/pose2.h"
#include "datmo_fusion/common/scan.h"
#include "datmo_fusion/common/stamp.h"
#include "datmo_fusion/common/twist2.h"

namespace datmo {

/// Returns the time from a scan's stamp to its last ray, s, 0 or more; 0 for a scan without rays.
double sweepDuration(const Scan& scan);

/// Returns the scan as if it had been measured in an instant, at its stamp: each ray (origin, end,
/// bearing) is transformed from the vehicle's frame at the ray's own time to that at the scan's
/// stamp, for a vehicle that moves at this constant twist. The rays' times become 0; ranges are
/// unchanged. The thesis treats all beams as simultaneous; at 14 m/s those of a scanner that takes
/// 27 ms for its field of view are then off by up to 0.4 m.
///
/// Moving objects stay where they were at the time of their rays.
Scan compensateMotion(Scan scan, const Twist2& twist);

/// Returns a compensated scan as the vehicle would have measured it at another time. `base`: pose
/// of the vehicle at the scan's stamp, in its frame at `stamp`. Moving objects stay where they
/// were.
Scan scanAt(Scan scan, Stamp stamp, const Pose2& base);

}  // namespace datmo
