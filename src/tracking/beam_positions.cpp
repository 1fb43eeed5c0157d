// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/tracking/beam_positions.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <set>
#include <utility>

namespace datmo {

namespace {

/// s, tolerance for stamps of the same scan.
constexpr double kSameScan = 0.03;

/// The scan taken at `time` on the clock of a target; none if it was dropped.
std::optional<std::size_t> scanAt(const ScanHistory& history, double time, Stamp now,
                                  double clock) {
  std::optional<std::size_t> nearest;
  double min_gap = kSameScan;
  for (std::size_t back = 0; back < history.size(); ++back) {
    const double gap = std::abs(clock + secondsBetween(now, history.stamp(back)) - time);
    if (gap < min_gap) {
      min_gap = gap;
      nearest = back;
    }
  }
  return nearest;
}

}  // namespace

BeamPositions::BeamPositions(const ScanHistory& history, const SeenPointHistory& seen, Stamp now,
                             double clock)
    : known_(history.size() == 0 || seen.scans().empty()) {
  std::set<std::optional<std::size_t>> beams;
  bool only_echoes = true;
  for (const auto& points : seen.scans()) {
    const auto back = scanAt(history, points->scan_time, now, clock);
    if (!back) {
      continue;
    }
    known_ = true;
    OfScan kept{*back, {points->time, points->scan_time, points->is_echo, {}}};
    std::copy_if(points->points.begin(), points->points.end(),
                 std::back_inserter(kept.points.points),
                 [&](const auto& point) { return history.endsAt(*back, point.position); });
    if (kept.points.points.empty()) {
      continue;
    }
    only_echoes = only_echoes && kept.points.is_echo;
    beams.insert(history.beamIndex(*back, kept.points.points.front().position));
    scans_.push_back(std::move(kept));
  }
  beams.erase(std::nullopt);  // between two beams, by the vehicle's motion during the scan
  keeps_beam_ = only_echoes && beams.size() == 1;
}

}  // namespace datmo
