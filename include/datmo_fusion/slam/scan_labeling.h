// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "datmo_fusion/common/scan.h"
#include "datmo_fusion/grid/occupancy_map.h"
#include "datmo_fusion/slam/kidnapping_detector.h"

namespace datmo {

/// Returns the state of each ray's end in the map, in order; kUnknown for beams without a hit.
std::vector<PointState> judgeRays(const Scan& scan, const OccupancyMap& map,
                                  const Pose2& base_in_map);

/// Counts the beams of a scan, whose ends have these states, that the map contradicts or confirms.
MapAgreement agreementOf(const Scan& scan, const std::vector<PointState>& states,
                         const OccupancyMap& map, const Pose2& base_in_map);

/// Returns the scan's hits with the states of its rays, and which of its beams are blind.
LabeledScan labelScan(const Scan& scan, const std::vector<PointState>& states,
                      const PoseWithCovariance& base_in_map);

}  // namespace datmo
