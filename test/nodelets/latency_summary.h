// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <nlohmann/json.hpp>

#include "datmo_fusion/common/quantile.h"

namespace datmo {

/// Returns figures of lists of tracks by their latencies, s; those of no list are null.
inline nlohmann::json latencySummary(const std::vector<double>& latencies) {
  if (latencies.empty()) {
    return {
        {"lists", 0}, {"median_s", nullptr}, {"percentile_99_s", nullptr}, {"worst_s", nullptr}};
  }
  return {{"lists", latencies.size()},
          {"median_s", quantile(latencies, 0.5)},
          {"percentile_99_s", quantile(latencies, 0.99)},
          {"worst_s", quantile(latencies, 1.0)}};
}

}  // namespace datmo
