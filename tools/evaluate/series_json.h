// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "evaluate/run_score.h"
#include <nlohmann/json.hpp>

namespace datmo::evaluation {

/// What plots over time and over the ground are drawn from: one value for each frame, and the paths
/// of true objects, tracks and the vehicle. PositionsTest and times are rounded to what a plot can
/// show.
nlohmann::json seriesJson(const RunScore& score);

}  // namespace datmo::evaluation
