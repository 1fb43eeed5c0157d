// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "evaluate/attainable.h"
#include <nlohmann/json.hpp>

namespace datmo::evaluation {

/// Median and 90 % quantile (nearest rank) of the delays relative to the attainable ones, over all
/// objects and by class. `delays`: of the objects, in their order.
nlohmann::json delaysJson(const std::vector<ObjectScore>& objects,
                          const std::vector<ComparedDelay>& delays);

/// Adds attainable_delay_s, excess_delay_s, delay_ratio and beams_per_scan to each of the `objects`
/// (a list in the order of `delays`).
void addDelays(const std::vector<ComparedDelay>& delays, nlohmann::json& objects);

}  // namespace datmo::evaluation
