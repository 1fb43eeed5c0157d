// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fstream>
#include <iostream>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include <ros/param.h>

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

/// Prints figures to the console and, with the samples that they are made of, as `key`, to the JSON
/// file that the test's parameter `out` names.
inline void writeFigures(nlohmann::json figures, const std::string& key,
                         const nlohmann::json& samples) {
  std::cout << figures.dump(1) << std::endl;
  const auto out = ros::param::param<std::string>("~out", "");
  if (!out.empty()) {
    figures[key] = samples;
    std::ofstream(out) << figures.dump() << "\n";
  }
}

}  // namespace datmo
