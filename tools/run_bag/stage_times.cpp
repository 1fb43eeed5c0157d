#include "stage_times.h"

#include <algorithm>

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
    summaries.push_back({stage, seconds.size(), quantile(seconds, 0.5), quantile(seconds, 0.99)});
  }
  return summaries;
}

}  // namespace datmo
