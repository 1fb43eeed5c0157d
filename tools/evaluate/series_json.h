// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "evaluate/run_score.h"
#include <nlohmann/json.hpp>

namespace datmo::evaluation {

/// Data for plots over time and over the ground: one value for each frame, and the paths of true
/// objects, tracks and the vehicle. Positions and times are rounded to the resolution of a plot.
nlohmann::json seriesJson(const RunScore& score);

}  // namespace datmo::evaluation
