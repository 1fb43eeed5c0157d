// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "kitti_tracking/tracking_evaluation.h"
#include <nlohmann/json.hpp>

namespace datmo::kitti {

/// One line for each score, in percent except for counts; "-": nothing of the class is required.
std::string toTable(const std::vector<TrackingScore>& scores);

/// All figures, as fractions, also those of each recall level.
nlohmann::json toJson(const std::vector<TrackingScore>& scores);

}  // namespace datmo::kitti
