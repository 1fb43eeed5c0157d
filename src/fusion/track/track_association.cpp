// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/fusion/track/track_association.h"

#include <cmath>
#include <iterator>

#include "datmo_fusion/assignment/assignment.h"

namespace datmo {

namespace {

/// Evidence may fall this much below `required` before an associated pair is separated.
constexpr double kAssociationHysteresis = 10.0;

}  // namespace

void TrackAssociationOptions::visit(OptionVisitor& visitor) {
  visitor.choice({"test", "",
                  "how it is decided that two tracks are one object: by their likelihoods, summed "
                  "over a window, or by the thesis's test of parallel trajectories (3.4.2)"},
                 test,
                 {{"accumulated", TrackAssociationTest::kAccumulated},
                  {"parallel", TrackAssociationTest::kParallel}});
  visitor.group("comparison", [&] { comparison.visit(visitor); });
  visitor.group("evidence", [&] { evidence.visit(visitor); });
  visitor.group("parallel", [&] { parallel.visit(visitor); });
  visitor.number({"required", "1",
                  "sum of log-likelihood ratios above which two tracks are one object (Wald 1947: "
                  "the logarithm of the inverse rate of false pairs)"},
                 required, {0.0, 100.0});
}

TrackAssociation::TrackAssociation(const Checked<TrackAssociationOptions>& options)
    : options_(*options) {}

std::vector<TrackGroup> TrackAssociation::associate(Stamp stamp,
                                                    const std::vector<PresentTracks>& sources) {
  candidates_.clear();
  std::vector<TrackGroup> groups;
  for (std::size_t list = 0; list < sources.size(); ++list) {
    for (std::size_t before = 0; before < list; ++before) {
      compareAll(stamp, sources, before, list);
    }
    join(groups, sources, list);
  }
  remember(stamp, groups);
  return groups;
}

void TrackAssociation::compareAll(Stamp stamp, const std::vector<PresentTracks>& sources,
                                  std::size_t one, std::size_t other) {
  const PresentTracks& ones = sources[one];
  const PresentTracks& others = sources[other];
  const bool fresh = ones.fresh || others.fresh;
  for (std::size_t i = 0; i < ones.tracks.size(); ++i) {
    for (std::size_t j = 0; j < others.tracks.size(); ++j) {
      const TrackKey a{ones.source, ones.tracks[i].id};
      const TrackKey b{others.source, others.tracks[j].id};
      // The order of the lists may change, that of the sources does not.
      const PairKey key = a < b ? PairKey{a, b} : PairKey{b, a};
      if (const auto score = scoreOf(stamp, ones.tracks[i], others.tracks[j], fresh, key)) {
        candidates_.push_back({{one, i}, {other, j}, *score, key});
      }
    }
  }
}

/// Distant pairs are not stored, so only neighbors need memory.
std::optional<double> TrackAssociation::scoreOf(Stamp stamp, const Track& a, const Track& b,
                                                bool fresh, const PairKey& key) {
  const TrackComparison now = compare(a, b, options_.comparison);
  if (!std::isfinite(now.squared_distance)) {
    return std::nullopt;
  }
  const bool in_gate = now.squared_distance <= options_.comparison.gate;
  auto known = pairs_.find(key);
  if (known == pairs_.end()) {
    if (!in_gate) {
      return std::nullopt;
    }
    known = pairs_.emplace(key, Pair()).first;
  }
  Pair& pair = known->second;
  if (fresh || pair.evidence.empty()) {
    pair.evidence.look(stamp, now.log_likelihood_ratio, options_.evidence);
  }
  const double association_hysteresis = pair.together ? kAssociationHysteresis : 0.0;
  if (options_.test == TrackAssociationTest::kParallel) {
    return in_gate && areParallel(a, b, options_.parallel)
               ? std::make_optional(options_.comparison.gate - now.squared_distance +
                                    association_hysteresis)
               : std::nullopt;
  }
  return in_gate || pair.together
             ? std::make_optional(pair.evidence.sum() - options_.required + association_hysteresis)
             : std::nullopt;
}

void TrackAssociation::join(std::vector<TrackGroup>& groups,
                            const std::vector<PresentTracks>& sources, std::size_t list) const {
  const auto rows = static_cast<Eigen::Index>(sources[list].tracks.size());
  const auto columns = static_cast<Eigen::Index>(groups.size());
  std::vector<std::vector<Eigen::Index>> column_of(list);
  for (std::size_t before = 0; before < list; ++before) {
    column_of[before].resize(sources[before].tracks.size());
  }
  for (Eigen::Index column = 0; column < columns; ++column) {
    for (const TrackPosition& position : groups[static_cast<std::size_t>(column)]) {
      column_of[position.list][position.track] = column;
    }
  }
  Eigen::MatrixXd scores = Eigen::MatrixXd::Zero(rows, columns);
  Eigen::MatrixXi agreeing = Eigen::MatrixXi::Zero(rows, columns);
  for (const Candidate& candidate : candidates_) {
    if (candidate.other.list == list) {
      const auto row = static_cast<Eigen::Index>(candidate.other.track);
      const Eigen::Index column = column_of[candidate.one.list][candidate.one.track];
      scores(row, column) += candidate.score;
      ++agreeing(row, column);
    }
  }
  CostMatrix cost = CostMatrix::Constant(rows, columns, kForbidden);
  for (Eigen::Index column = 0; column < columns; ++column) {
    const auto members = static_cast<int>(groups[static_cast<std::size_t>(column)].size());
    for (Eigen::Index row = 0; row < rows; ++row) {
      // All of the group agree with it, on average with more than the required evidence.
      if (agreeing(row, column) == members && scores(row, column) > 0.0) {
        cost(row, column) = -scores(row, column) / members;
      }
    }
  }
  const Assignment assignment = solveAssignment(cost, Eigen::VectorXd::Zero(rows));
  for (std::size_t track = 0; track < assignment.column_of_row.size(); ++track) {
    const int column = assignment.column_of_row[track];
    if (column == kUnassigned) {
      groups.push_back({{list, track}});
    } else {
      groups[static_cast<std::size_t>(column)].push_back({list, track});
    }
  }
}

void TrackAssociation::remember(Stamp stamp, const std::vector<TrackGroup>& groups) {
  for (auto pair = pairs_.begin(); pair != pairs_.end();) {
    pair->second.together = false;
    pair->second.evidence.forgetBefore(stamp, options_.evidence);
    pair = pair->second.evidence.empty() ? pairs_.erase(pair) : std::next(pair);
  }
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> group_of;
  for (std::size_t group = 0; group < groups.size(); ++group) {
    for (const TrackPosition& position : groups[group]) {
      group_of[{position.list, position.track}] = group;
    }
  }
  for (const Candidate& candidate : candidates_) {
    const auto groupOf = [&](const TrackPosition& position) {
      return group_of.at({position.list, position.track});
    };
    const auto pair = pairs_.find(candidate.key);
    if (pair != pairs_.end() && groupOf(candidate.one) == groupOf(candidate.other)) {
      pair->second.together = true;
    }
  }
}

}  // namespace datmo
