// SPDX-License-Identifier: BSD-3-Clause
#include "kitti_tracking/truth_history.h"

#include <algorithm>

namespace datmo::kitti {

namespace {

constexpr double kMostlyTracked = 0.8;
constexpr double kMostlyLost = 0.2;

using Coverage = TruthSummary::Coverage;

bool isMatched(const TruthRecord& record) { return record.track != kUnassigned; }

Coverage coverageOf(std::size_t tracked, std::size_t required) {
  const double share = static_cast<double>(tracked) / static_cast<double>(required);
  if (share > kMostlyTracked) {
    return Coverage::kMostly;
  }
  return share < kMostlyLost ? Coverage::kMostlyLost : Coverage::kPartly;
}

/// Whether the match in frame `i`, with `last_track` as the last track before it, begins a new
/// piece of the trajectory.
bool isFragmentation(const std::vector<TruthRecord>& records, std::size_t i, int last_track) {
  const bool differs = records[i].track != records[i - 1].track;
  const bool is_last = i + 1 == records.size();
  return differs && (is_last || (last_track != kUnassigned && isMatched(records[i + 1])));
}

std::size_t countRequired(const std::vector<TruthRecord>& records) {
  return static_cast<std::size_t>(std::count_if(
      records.begin(), records.end(), [](const TruthRecord& record) { return record.required; }));
}

}  // namespace

TruthSummary summarize(const std::vector<TruthRecord>& records) {
  TruthSummary summary;
  const std::size_t required = countRequired(records);
  if (required == 0) {
    return summary;
  }
  int last_track = records.front().track;
  std::size_t tracked = isMatched(records.front()) ? 1 : 0;
  for (std::size_t i = 1; i < records.size(); ++i) {
    const TruthRecord& record = records[i];
    if (!record.required) {
      last_track = kUnassigned;
    } else if (isMatched(record)) {
      const bool switches = last_track != kUnassigned && last_track != record.track;
      summary.id_switches += switches && isMatched(records[i - 1]) ? 1U : 0U;
      summary.fragmentations += isFragmentation(records, i, last_track) ? 1U : 0U;
      last_track = record.track;
      ++tracked;
    }
  }
  summary.coverage = coverageOf(tracked, required);
  return summary;
}

}  // namespace datmo::kitti
