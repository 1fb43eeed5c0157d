// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/road/presence_history.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "datmo_fusion/common/log_odds.h"

namespace datmo {

namespace {

/// Time constant for forgetting stations ahead that are no longer observed, s.
constexpr double kForgetTime = 5.0;

/// Stations farther behind the vehicle are frozen, m.
constexpr double kUpdatedTo = 2.0;

constexpr double kStationLength = 1.0;  ///< m
constexpr double kMinStep = 0.2;        ///< m, minimum driven distance

/// Probability without any information.
constexpr double kUnknown = 0.5;

/// Evidence of a line at a station; gaps bridged by a section count like the section.
double logOddsOf(const FollowedBorder& border, const std::vector<ArcLengthInterval>& pieces,
                 double arc_length) {
  for (const ArcLengthInterval& piece : pieces) {
    if (arc_length >= piece.first && arc_length <= piece.last) {
      return border.evidence().saturation();
    }
  }
  return -border.evidence().openLogOdds(arc_length);
}

}  // namespace

void PresenceHistoryOptions::visit(OptionVisitor& visitor) {
  visitor.number({"ahead", "m", "how far ahead of the vehicle"}, ahead, {1.0, 200.0});
  visitor.number({"behind", "m", "how far behind the vehicle"}, behind, {0.0, 200.0});
}

PresenceHistory::PresenceHistory(const PresenceHistoryOptions& options) : options_(options) {}

void PresenceHistory::reset() {
  presence_ = {};
  vehicle_.reset();
  counted_.reset();
}

void PresenceHistory::shift(SidePresence& side) const {
  const double first =
      kStationLength *
      (std::floor((presence_.arc_length - options_.behind) / kStationLength) + 0.5);
  const auto count =
      static_cast<std::size_t>(std::ceil((options_.ahead + options_.behind) / kStationLength)) + 1;
  const auto passed = static_cast<std::ptrdiff_t>(
      side.probability.empty() ? 0.0 : std::round((first - side.first_station) / kStationLength));
  side.station_length = kStationLength;
  side.first_station = first;
  std::vector<double>& values = side.probability;
  values.erase(values.begin(),
               values.begin() + std::min(passed, static_cast<std::ptrdiff_t>(values.size())));
  values.resize(count, kUnknown);
}

void PresenceHistory::moveTo(const Pose2& base_in_map) {
  vehicle_ = base_in_map;
  if (!counted_) {
    counted_ = base_in_map;
  }
  // Neither pose jitter of a standing vehicle nor driving backward counts as distance driven.
  const Point2 step = counted_->inverse() * base_in_map.position();
  if (step.norm() >= kMinStep) {
    presence_.arc_length += step.x() > 0.0 ? step.norm() : 0.0;
    counted_ = base_in_map;
  }
  shift(presence_.left);
  shift(presence_.right);
}

void PresenceHistory::update(const std::vector<FollowedBorder>& borders, RoadSide which,
                             double seconds, SidePresence& side) {
  updated_.assign(side.probability.size(), std::nullopt);
  const Pose2 map_in_base = vehicle_->inverse();
  for (const FollowedBorder& border : borders) {
    if (border.side() != which || border.state() != FollowedBorder::State::kConfirmed) {
      continue;
    }
    const std::vector<ArcLengthInterval> pieces = border.evidence().pieces();
    const CurveTable& table = border.table();
    for (double along = table.first(); along <= table.last(); along += 0.5 * kStationLength) {
      const double ahead = (map_in_base * table.at(along).position()).x();
      const double log_odds = logOddsOf(border, pieces, border.track().arcLength() + along);
      const double index =
          std::floor((presence_.arc_length + ahead - side.first_station) / kStationLength + 0.5);
      if (ahead < -kUpdatedTo || index < 0.0 || index >= static_cast<double>(updated_.size()) ||
          log_odds == 0.0) {
        continue;
      }
      std::optional<double>& updated = updated_[static_cast<std::size_t>(index)];
      updated = std::max(updated.value_or(log_odds), log_odds);
    }
  }
  const double kept = std::exp(-seconds / kForgetTime);
  for (std::size_t i = 0; i < updated_.size(); ++i) {
    double& probability = side.probability[i];
    const double ahead =
        side.first_station + static_cast<double>(i) * kStationLength - presence_.arc_length;
    if (updated_[i]) {
      probability = probabilityOf(*updated_[i]);
    } else if (ahead > 0.0) {
      probability = kUnknown + kept * (probability - kUnknown);
    }
  }
}

void PresenceHistory::update(const std::vector<FollowedBorder>& borders, const Pose2& base_in_map,
                             double seconds) {
  moveTo(base_in_map);
  update(borders, RoadSide::kLeft, seconds, presence_.left);
  update(borders, RoadSide::kRight, seconds, presence_.right);
}

}  // namespace datmo
