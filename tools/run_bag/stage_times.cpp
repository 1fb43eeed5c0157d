// SPDX-License-Identifier: BSD-3-Clause
#include "stage_times.h"

#include <algorithm>
#include <numeric>

#include <nlohmann/json.hpp>

#include "datmo_fusion/common/quantile.h"

namespace datmo {

void StageTimes::add(const std::string& stage, double seconds) {
  const auto known = std::find_if(seconds_.begin(), seconds_.end(),
                                  [&](const auto& entry) { return entry.first == stage; });
  if (known == seconds_.end()) {
    seconds_.push_back({stage, {seconds}});
  } else {
    known->second.push_back(seconds);
  }
}

std::vector<StageTimes::Summary> StageTimes::summaries() const {
  std::vector<Summary> summaries;
  for (const auto& [stage, seconds] : seconds_) {
    const double sum = std::accumulate(seconds.begin(), seconds.end(), 0.0);
    summaries.push_back({stage, seconds.size(), sum / static_cast<double>(seconds.size()),
                         quantile(seconds, 0.5), quantile(seconds, 0.99)});
  }
  return summaries;
}

std::string toJson(const StageTimes& times) {
  nlohmann::json stages = nlohmann::json::object();
  for (const StageTimes::Summary& stage : times.summaries()) {
    stages[stage.stage] = {{"runs", stage.runs},
                           {"mean_s", stage.mean},
                           {"median_s", stage.median},
                           {"percentile_99_s", stage.percentile_99}};
  }
  return stages.dump(2) + "\n";
}

}  // namespace datmo
