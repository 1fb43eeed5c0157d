// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/tracking/hypothesis_expansion.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <utility>

#include "planned_cluster.h"
#include "ranked_hypothesis.h"

namespace datmo {

namespace {

/// Assignments that are evaluated for each hypothesis that may be kept: if track trees are full,
/// hardly any of the many remaining ones fits.
constexpr std::size_t kMaxAssignmentsPerHypothesis = 10;

std::vector<RankedHypothesis> sourcesOf(const HypothesisCluster& cluster,
                                        const std::vector<Interpretation>& interpretations,
                                        const ExpansionContext& context,
                                        AssociationCounts& counts) {
  std::vector<RankedHypothesis> sources;
  double best = -std::numeric_limits<double>::infinity();
  for (const GlobalHypothesis& hypothesis : cluster.hypotheses) {
    for (const Interpretation& interpretation : interpretations) {
      RankedHypothesis source(cluster, context.scan, hypothesis, interpretation);
      if (source.bound() < best + std::log(context.options.min_ratio)) {
        continue;
      }
      source.rank(context.max_work);
      counts.cut_hypotheses += source.cut() ? 1 : 0;
      if (source.isDone()) {
        continue;
      }
      if (&interpretation == &interpretations.front()) {
        best = std::max(best, source.weight());
      }
      sources.push_back(std::move(source));
      if (context.best_only) {
        return sources;
      }
    }
  }
  return sources;
}

}  // namespace

void HypothesisOptions::visit(OptionVisitor& visitor) {
  visitor.integer({"max_hypotheses", "1",
                   "global hypotheses that a cluster of targets keeps (the m best by Murty 1968)"},
                  max_hypotheses, {1, 1000});
  visitor.integer(
      {"scan_history", "1",
       "scans after which a decision is final (N-scan pruning, thesis 3.3.4): 0 decides "
       "at once"},
      scan_history, {0, static_cast<double>(kMaxScanHistory)});
  visitor.integer({"max_leaves", "1", "maximum number of observation sequences of one target"},
                  max_leaves, {1, 1000});
  visitor.number({"min_ratio", "1",
                  "a hypothesis that is less likely than this share of the best one is dropped"},
                 min_ratio, {0.0, 1.0});
  visitor.integer(
      {"max_joint_targets", "1",
       "a cluster of more targets keeps a single hypothesis; bounds the time of a step"},
      max_joint_targets, {1, 1000});
}

HypothesisCluster expand(HypothesisCluster cluster,
                         const std::vector<Interpretation>& interpretations,
                         const ExpansionContext& context, std::uint64_t& next_node,
                         std::size_t& room, AssociationCounts& counts) {
  std::vector<RankedHypothesis> sources = sourcesOf(cluster, interpretations, context, counts);
  const auto isLess = [&](std::size_t a, std::size_t b) {
    return std::make_pair(sources[a].weight(), b) < std::make_pair(sources[b].weight(), a);
  };
  std::priority_queue<std::size_t, std::vector<std::size_t>, decltype(isLess)> queue(isLess);
  for (std::size_t i = 0; i < sources.size(); ++i) {
    queue.push(i);
  }
  const std::size_t max =
      context.best_only ? 1 : static_cast<std::size_t>(context.options.max_hypotheses);
  const double lowest = std::log(context.options.min_ratio);
  counts.cut_hypotheses += context.best_only ? cluster.hypotheses.size() - 1 : 0;
  PlannedCluster next(cluster, context, next_node, room, counts);
  for (std::size_t looks = 0; !queue.empty(); ++looks) {
    RankedHypothesis& source = sources[queue.top()];
    if (next.size() > 0 && source.weight() < next.bestWeight() + lowest) {
      break;
    }
    if (next.size() == max || looks == kMaxAssignmentsPerHypothesis * max) {
      ++counts.cut_hypotheses;
      break;
    }
    const std::size_t index = queue.top();
    queue.pop();
    next.add(source);
    source.advance();
    if (!source.isDone()) {
      queue.push(index);
    }
  }
  return next.finish();
}

}  // namespace datmo
