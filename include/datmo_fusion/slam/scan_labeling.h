// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "datmo_fusion/common/scan.h"
#include "datmo_fusion/grid/occupancy_map.h"
#include "datmo_fusion/slam/kidnapping_detector.h"

namespace datmo {

/// State of each ray by the map in which it ends, in order; kUnknown for beams without a hit.
std::vector<PointState> judgeRays(const Scan& scan, const OccupancyMap& map,
                                  const Pose2& base_in_map);

/// How many of a scan's beams, whose ends have these states, the map contradicts.
MapAgreement agreementOf(const Scan& scan, const std::vector<PointState>& states,
                         const OccupancyMap& map, const Pose2& base_in_map);

/// The scan's hits with these states of its rays, and which of its beams saw nothing at all.
LabeledScan labelScan(const Scan& scan, const std::vector<PointState>& states,
                      const PoseWithCovariance& base_in_map);

}  // namespace datmo
