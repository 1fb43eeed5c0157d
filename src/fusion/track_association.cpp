#include "datmo_fusion/fusion/track_association.h"

#include <algorithm>

#include "datmo_fusion/tracking/assignment.h"

namespace datmo {

void TrackAssociationOptions::visit(OptionVisitor& visitor) {
  visitor.text({"test", "",
                "when two tracks are one: by their likelihoods, summed over a window, or by the "
                "thesis's test of parallel trajectories (3.4.2)"},
               test, {kAccumulated, kParallel});
  visitor.group("comparison", [&] { comparison.visit(visitor); });
  visitor.group("evidence", [&] { evidence.visit(visitor); });
  visitor.group("parallel", [&] { parallel.visit(visitor); });
  visitor.number({"required", "1",
                  "sum of log-likelihood ratios from which two tracks are one (Wald 1947: the "
                  "logarithm of the inverse rate of false pairs)"},
                 required, {0.0, 100.0});
  visitor.number({"loyalty", "1", "by how much it may fall below that before they part"}, loyalty,
                 {0.0, 100.0});
}

TrackAssociation::TrackAssociation(const TrackAssociationOptions& options) : options_(options) {
  checkOptions(options);
}

std::vector<TrackGroup> TrackAssociation::associate(Stamp stamp,
                                                    const std::vector<PresentTracks>& sources) {
  for (std::size_t list = 0; list < sources.size(); ++list) {
    for (std::size_t other = 0; other < list; ++other) {
      compareAll(stamp, sources[other], sources[list]);
    }
  }
  std::vector<TrackGroup> groups;
  for (std::size_t list = 0; list < sources.size(); ++list) {
    join(groups, sources, list);
  }
  remember(stamp, groups, sources);
  return groups;
}

TrackAssociation::PairKey TrackAssociation::keyOf(const PresentTracks& one, const Track& a,
                                                  const PresentTracks& other, const Track& b) {
  const TrackKey first{one.source, a.id};
  const TrackKey second{other.source, b.id};
  return first < second ? PairKey{first, second} : PairKey{second, first};
}

void TrackAssociation::compareAll(Stamp stamp, const PresentTracks& one,
                                  const PresentTracks& other) {
  const bool fresh = one.fresh || other.fresh;
  for (const Track& a : one.tracks) {
    for (const Track& b : other.tracks) {
      compareTwo(stamp, a, b, fresh, keyOf(one, a, other, b));
    }
  }
}

/// What is far apart and always was leaves no trace: so there are as many pairs as neighbours.
void TrackAssociation::compareTwo(Stamp stamp, const Track& a, const Track& b, bool fresh,
                                  const PairKey& key) {
  const TrackComparison now = compare(a, b, options_.comparison);
  const bool in_gate = now.squared_distance <= options_.comparison.gate;
  auto known = pairs_.find(key);
  if (known == pairs_.end()) {
    if (!in_gate) {
      return;
    }
    known = pairs_.emplace(key, Pair()).first;
  }
  Pair& pair = known->second;
  if (fresh || pair.evidence.empty()) {
    pair.evidence.look(stamp, now.log_likelihood_ratio, options_.evidence);
  }
  const bool by_evidence = options_.test == TrackAssociationOptions::kAccumulated;
  const double agreement = by_evidence ? pair.evidence.sum() - options_.required
                                       : options_.comparison.gate - now.squared_distance;
  const bool may_be_one =
      by_evidence ? in_gate || pair.together : in_gate && areParallel(a, b, options_.parallel);
  pair.compared = may_be_one;
  pair.score = agreement + (pair.together ? options_.loyalty : 0.0);
}

double TrackAssociation::scoreOf(const TrackGroup& group, const std::vector<PresentTracks>& sources,
                                 std::size_t list, std::size_t track) const {
  double sum = 0.0;
  for (const TrackPlace& place : group) {
    const PresentTracks& other = sources[place.list];
    const auto pair = pairs_.find(
        keyOf(other, other.tracks[place.track], sources[list], sources[list].tracks[track]));
    if (pair == pairs_.end() || !pair->second.compared) {
      return -kForbidden;
    }
    sum += pair->second.score;
  }
  return sum / static_cast<double>(group.size());
}

void TrackAssociation::join(std::vector<TrackGroup>& groups,
                            const std::vector<PresentTracks>& sources, std::size_t list) const {
  const auto rows = static_cast<Eigen::Index>(sources[list].tracks.size());
  CostMatrix cost(rows, static_cast<Eigen::Index>(groups.size()));
  for (Eigen::Index row = 0; row < rows; ++row) {
    for (Eigen::Index column = 0; column < cost.cols(); ++column) {
      const double score = scoreOf(groups[static_cast<std::size_t>(column)], sources, list,
                                   static_cast<std::size_t>(row));
      cost(row, column) = score > 0.0 ? -score : kForbidden;
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

void TrackAssociation::remember(Stamp stamp, const std::vector<TrackGroup>& groups,
                                const std::vector<PresentTracks>& sources) {
  for (auto pair = pairs_.begin(); pair != pairs_.end();) {
    pair->second.together = false;
    pair->second.compared = false;
    pair->second.evidence.forgetBefore(stamp, options_.evidence);
    pair = pair->second.evidence.empty() ? pairs_.erase(pair) : std::next(pair);
  }
  const auto trackAt = [&](const TrackPlace& place) -> const Track& {
    return sources[place.list].tracks[place.track];
  };
  for (const TrackGroup& group : groups) {
    for (std::size_t i = 0; i < group.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        const auto pair = pairs_.find(keyOf(sources[group[i].list], trackAt(group[i]),
                                            sources[group[j].list], trackAt(group[j])));
        if (pair != pairs_.end()) {
          pair->second.together = true;
        }
      }
    }
  }
}

}  // namespace datmo
