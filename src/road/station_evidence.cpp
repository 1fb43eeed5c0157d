// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/road/station_evidence.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace datmo {

namespace {

/// Probability that a beam through the mouth of a street sees deep into it, and that one beside a
/// street does not.
constexpr double kDepthProbability = 0.6;

constexpr double kStation = 1.0;  ///< m

/// Stations beyond, and NaN, are set to this limit.
constexpr double kFarthest = 1 << 28;

int indexOf(double along) {
  // In this order NaN becomes the lower limit.
  return static_cast<int>(std::min(kFarthest, std::max(-kFarthest, std::floor(along / kStation))));
}

}  // namespace

void StationEvidenceOptions::visit(OptionVisitor& visitor) {
  visitor.number({"hit_probability", "1",
                  "probability that a beam that crosses a border ends there: for curbs"},
                 hit_probability, {0.01, 0.99});
  visitor.number({"clutter", "1", "probability that it ends there although there is no border"},
                 clutter, {1e-4, 0.5});
  visitor.number({"max_per_scan", "1",
                  "largest change of the log odds at a station in one scan: its beams there see "
                  "the same surface"},
                 max_per_scan, {0.1, 10.0});
  visitor.number({"saturation", "1", "limit of the log odds, up and down"}, saturation,
                 {0.5, 20.0});
  visitor.number({"seen", "1", "log odds above which there is a border"}, seen, {0.0, 20.0});
  visitor.number(
      {"bridged_gap", "m", "shorter gaps belong to the border: between parked cars, driveways"},
      bridged_gap, {0.0, 50.0});
}

StationEvidence::StationEvidence(const StationEvidenceOptions& options)
    : options_(options),
      hit_(std::log(options.hit_probability / options.clutter)),
      passage_(std::log((1.0 - options.hit_probability) / (1.0 - options.clutter))),
      depth_(std::log(kDepthProbability / (1.0 - kDepthProbability))) {}

void StationEvidence::keepWithin(const ArcLengthInterval& interval) {
  const int first = indexOf(interval.first);
  const int last = std::max(first, indexOf(interval.last));
  const bool apart = first >= first_ + static_cast<int>(stations_.size()) || last < first_;
  if (apart) {
    stations_.clear();
    first_ = first;
  }
  while (first_ < first) {
    stations_.pop_front();
    ++first_;
  }
  while (first_ > first) {
    stations_.emplace_front();
    --first_;
  }
  stations_.resize(static_cast<std::size_t>(last - first) + 1);
}

std::size_t StationEvidence::slotAt(double along) const {
  const int offset = indexOf(along) - first_;
  return offset >= 0 ? std::min(static_cast<std::size_t>(offset), stations_.size())
                     : stations_.size();
}

const StationEvidence::Station* StationEvidence::stationAt(double along) const {
  const std::size_t slot = slotAt(along);
  return slot < stations_.size() ? &stations_[slot] : nullptr;
}

StationEvidence::Station* StationEvidence::stationAt(double along) {
  const std::size_t slot = slotAt(along);
  return slot < stations_.size() ? &stations_[slot] : nullptr;
}

void StationEvidence::addHit(double along) {
  if (Station* station = stationAt(along)) {
    station->update += hit_;
  }
}

void StationEvidence::addPassage(double along) {
  if (Station* station = stationAt(along)) {
    station->update += passage_;
  }
}

void StationEvidence::addDepth(double along, bool deep) {
  if (Station* station = stationAt(along)) {
    station->open_update += deep ? depth_ : -depth_;
  }
}

void StationEvidence::endScan() {
  const auto add = [this](double update, double& sum) {
    const double step = std::clamp(update, -options_.max_per_scan, options_.max_per_scan);
    sum = std::clamp(sum + step, -options_.saturation, options_.saturation);
  };
  for (Station& station : stations_) {
    add(station.update, station.log_odds);
    add(station.open_update, station.open_log_odds);
    station.update = 0.0;
    station.open_update = 0.0;
  }
}

double StationEvidence::logOdds(double along) const {
  const Station* station = stationAt(along);
  return station != nullptr ? station->log_odds : 0.0;
}

double StationEvidence::openLogOdds(double along) const {
  const Station* station = stationAt(along);
  return station != nullptr ? station->open_log_odds : 0.0;
}

std::vector<ArcLengthInterval> StationEvidence::pieces() const {
  std::vector<ArcLengthInterval> pieces;
  double begin = first_ * kStation;
  for (const Station& station : stations_) {
    if (station.log_odds >= options_.seen) {
      if (pieces.empty() || begin - pieces.back().last >= options_.bridged_gap) {
        pieces.push_back({begin, begin});
      }
      pieces.back().last = begin + kStation;
    }
    begin += kStation;
  }
  return pieces;
}

int StationEvidence::seenStations() const {
  return static_cast<int>(
      std::count_if(stations_.begin(), stations_.end(),
                    [this](const Station& station) { return station.log_odds >= options_.seen; }));
}

}  // namespace datmo
