// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <nlohmann/json.hpp>

#include "datmo_fusion/common/quantile.h"

namespace datmo {

/// Returns figures of lists of tracks by their latencies, s.
inline nlohmann::json latencySummary(const std::vector<double>& latencies) {
  return {{"lists", latencies.size()},
          {"median_s", quantile(latencies, 0.5)},
          {"percentile_99_s", quantile(latencies, 0.99)},
          {"worst_s", quantile(latencies, 1.0)}};
}

}  // namespace datmo
