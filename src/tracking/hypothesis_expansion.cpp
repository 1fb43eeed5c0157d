// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/tracking/hypothesis_expansion.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <queue>
#include <set>
#include <utility>

#include "ranked_hypothesis.h"

namespace datmo {

namespace {

/// Assignments that are looked at for each hypothesis that may be kept: where track trees are full,
/// hardly any of the many that are left finds room.
constexpr std::size_t kMaxScans = 10;

/// Room that the leaves of a tree get at once: seen, and not.
constexpr std::size_t kUsualLeaves = 2;

/// The cluster of the next scan, as its hypotheses come in.
class Builder {
 public:
  Builder(const HypothesisCluster& cluster, const ExpansionContext& context,
          std::uint64_t& next_node, std::size_t& room, AssociationCounts& counts)
      : old_(cluster),
        context_(context),
        next_node_(next_node),
        room_(room),
        counts_(counts),
        trees_(cluster.trees.size()),
        made_(cluster.trees.size()) {}

  /// Adds the present assignment of a source, unless it needs more leaves than there may be.
  void add(const RankedHypothesis& source) {
    const std::vector<std::size_t> measurement_index = source.observations();
    if (!hasRoomFor(source.parent(), measurement_index)) {
      ++counts_.cut_hypotheses;
      return;
    }
    GlobalHypothesis child{source.weight(), {}};
    for (std::size_t tree = 0; tree < old_.trees.size(); ++tree) {
      const int leaf = source.parent().leaf_of_tree[tree];
      child.leaf_of_tree.push_back(leaf == kAbsent ? kAbsent
                                                   : leafFor(tree, leaf, measurement_index[tree]));
    }
    child.leaf_of_tree.resize(trees_.size(), kAbsent);
    for (const std::size_t observation : source.interpretation()) {
      if (std::find(measurement_index.begin(), measurement_index.end(), observation) ==
          measurement_index.end()) {
        startTarget(observation, child);
      }
    }
    hypotheses_.push_back(std::move(child));
  }

  std::size_t size() const { return hypotheses_.size(); }
  double bestWeight() const { return hypotheses_.front().log_weight; }

  HypothesisCluster finish() {
    for (GlobalHypothesis& hypothesis : hypotheses_) {
      hypothesis.leaf_of_tree.resize(trees_.size(), kAbsent);
    }
    HypothesisCluster result{std::move(trees_), std::move(hypotheses_), old_.links};
    linkSharers(result);
    canonicalize(result);
    return result;
  }

 private:
  /// Which leaf of the old tree went on as what, to which leaf of the new one.
  struct Made {
    int parent;
    std::size_t observation;
    int leaf;
  };

  int find(std::size_t tree, int parent, std::size_t observation) const {
    for (const Made& made : made_[tree]) {
      if (made.parent == parent && made.observation == observation) {
        return made.leaf;
      }
    }
    return kAbsent;
  }

  bool hasRoomFor(const GlobalHypothesis& parent,
                  const std::vector<std::size_t>& measurement_index) const {
    for (std::size_t tree = 0; tree < old_.trees.size(); ++tree) {
      const int leaf = parent.leaf_of_tree[tree];
      const bool full =
          trees_[tree].leaves.size() >= static_cast<std::size_t>(context_.options.max_leaves);
      if (leaf != kAbsent && full && find(tree, leaf, measurement_index[tree]) == kAbsent) {
        return false;
      }
    }
    return true;
  }

  int leafFor(std::size_t tree, int parent, std::size_t observation) {
    const int found = find(tree, parent, observation);
    if (found != kAbsent) {
      return found;
    }
    const Leaf& old = old_.trees[tree].leaves[static_cast<std::size_t>(parent)];
    Leaf& leaf = append(tree, parent, observation, old.child(next_node_++));
    const double seen = old.scores.detection_probability;
    if (observation == kUnseen) {
      leaf.target.miss(seen, context_.target);
    } else {
      leaf.target.update(context_.scan.observations[observation], observation, seen,
                         context_.target);
      noteUse(observation, leaf.target.number());
    }
    return made_[tree].back().leaf;
  }

  Leaf& append(std::size_t tree, int parent, std::size_t observation, Leaf&& leaf) {
    const int index = static_cast<int>(trees_[tree].leaves.size());
    if (index == 0) {
      trees_[tree].leaves.reserve(kUsualLeaves);
    }
    trees_[tree].leaves.push_back(std::move(leaf));
    made_[tree].push_back({parent, observation, index});
    return trees_[tree].leaves.back();
  }

  void startTarget(std::size_t observation, GlobalHypothesis& child) {
    if (!context_.scan.observations[observation].starts_target) {
      return;
    }
    const auto known = tree_of_birth_.find(observation);
    if (known != tree_of_birth_.end()) {
      child.leaf_of_tree[known->second] = 0;
      return;
    }
    if (room_ == 0) {
      counts_.refused_births += refused_.insert(observation).second ? 1 : 0;
      return;
    }
    --room_;
    tree_of_birth_[observation] = trees_.size();
    trees_.emplace_back();
    made_.emplace_back();
    const Object& object = context_.scan.observations[observation].object;
    Leaf leaf{Target(object, observation, context_.first_number + observation, context_.target,
                     context_.scan.transitionsOf(object.object_class)),
              {},
              {},
              {}};
    leaf.nodes.front() = next_node_++;
    noteUse(observation, leaf.target.number());
    append(trees_.size() - 1, kAbsent, observation, std::move(leaf));
    child.leaf_of_tree.push_back(0);
  }

  void noteUse(std::size_t observation, std::uint64_t number) {
    for (const std::size_t source : context_.scan.observations[observation].sources) {
      users_[source].insert(number);
    }
  }

  /// Targets that may have been seen as the same object depend on each other.
  void linkSharers(HypothesisCluster& cluster) const {
    for (const auto& entry : users_) {
      const std::set<std::uint64_t>& users = entry.second;
      for (auto user = std::next(users.begin()); user != users.end(); ++user) {
        cluster.links.push_back({context_.scan_number, *users.begin(), *user});
      }
    }
  }

  const HypothesisCluster& old_;
  const ExpansionContext& context_;
  std::uint64_t& next_node_;
  std::size_t& room_;
  AssociationCounts& counts_;
  std::vector<TrackTree> trees_;  ///< the old ones, then those that start now
  std::vector<std::vector<Made>> made_;
  std::vector<GlobalHypothesis> hypotheses_;
  std::map<std::size_t, std::size_t> tree_of_birth_;      ///< by observation
  std::set<std::size_t> refused_;                         ///< observations that found no room
  std::map<std::size_t, std::set<std::uint64_t>> users_;  ///< targets, by object
};

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
  visitor.integer({"max_leaves", "1", "observation sequences of one target that are kept"},
                  max_leaves, {1, 1000});
  visitor.number({"min_ratio", "1",
                  "a hypothesis that is less likely than this share of the best one is dropped"},
                 min_ratio, {0.0, 1.0});
  visitor.integer(
      {"max_joint_targets", "1",
       "a cluster of more targets keeps a single hypothesis; bounds the time of a step"},
      max_joint_targets, {1, 1000});
}

HypothesisCluster expand(const HypothesisCluster& cluster,
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
  Builder builder(cluster, context, next_node, room, counts);
  for (std::size_t looks = 0; !queue.empty(); ++looks) {
    RankedHypothesis& source = sources[queue.top()];
    if (builder.size() > 0 && source.weight() < builder.bestWeight() + lowest) {
      break;
    }
    if (builder.size() == max || looks == kMaxScans * max) {
      ++counts.cut_hypotheses;
      break;
    }
    const std::size_t index = queue.top();
    queue.pop();
    builder.add(source);
    source.advance();
    if (!source.isDone()) {
      queue.push(index);
    }
  }
  return builder.finish();
}

}  // namespace datmo
