// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/tracking/hypothesis_expansion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <map>
#include <queue>
#include <set>
#include <utility>

#include "ranked_hypothesis.h"

#include "datmo_fusion/tracking/hypothesis_pruning.h"

namespace datmo {

namespace {

/// Assignments that are looked at for each hypothesis that may be kept: where track trees are full,
/// hardly any of the many that are left finds room.
constexpr std::size_t kMaxScans = 10;

/// Of new targets.
constexpr std::size_t kNoTree = std::numeric_limits<std::size_t>::max();

/// A leaf of the next scan before its target is made: most of those that hypotheses ask for do not
/// outlive the pruning, and a target is costly to update.
struct PlannedLeaf {
  int parent;               ///< leaf of the old tree that it continues; kAbsent: a new target
  std::size_t observation;  ///< kUnseen: missed
  std::array<std::uint64_t, kMaxScanHistory + 1> nodes;
};

struct PlannedTree {
  std::size_t old_tree = kNoTree;  ///< that it continues
  std::vector<PlannedLeaf> leaves;
};

/// The cluster of the next scan, as its hypotheses come in.
class Builder {
 public:
  Builder(HypothesisCluster& cluster, const ExpansionContext& context, std::uint64_t& next_node,
          std::size_t& room, AssociationCounts& counts)
      : old_(cluster),
        context_(context),
        next_node_(next_node),
        room_(room),
        counts_(counts),
        trees_(cluster.trees.size()) {
    for (std::size_t tree = 0; tree < trees_.size(); ++tree) {
      trees_[tree].old_tree = tree;
    }
  }

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

  /// Prunes, and makes the targets of what is left, out of the old ones: to be called last.
  HypothesisCluster finish() {
    for (GlobalHypothesis& hypothesis : hypotheses_) {
      hypothesis.leaf_of_tree.resize(trees_.size(), kAbsent);
    }
    canonicalize(trees_, hypotheses_);
    if (hypotheses_.size() > 1) {
      pruneHistory(trees_, hypotheses_, static_cast<std::size_t>(context_.options.scan_history));
    }
    HypothesisCluster result{{}, std::move(hypotheses_), std::move(old_.links)};
    linkSharers(result);
    for (const PlannedTree& plan : trees_) {
      result.trees.push_back(grow(plan));
    }
    return result;
  }

 private:
  int find(std::size_t tree, int parent, std::size_t observation) const {
    const std::vector<PlannedLeaf>& leaves = trees_[tree].leaves;
    const auto found = std::find_if(leaves.begin(), leaves.end(), [&](const PlannedLeaf& leaf) {
      return leaf.parent == parent && leaf.observation == observation;
    });
    return found == leaves.end() ? kAbsent : static_cast<int>(found - leaves.begin());
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
    const TrackTree& old = old_.trees[tree];
    PlannedLeaf leaf{parent, observation, {}};
    const auto& nodes = old.leaves[static_cast<std::size_t>(parent)].nodes;
    std::copy(nodes.begin(), nodes.end() - 1, leaf.nodes.begin() + 1);
    leaf.nodes.front() = next_node_++;
    if (observation != kUnseen) {
      noteUse(observation, old.number());
    }
    trees_[tree].leaves.push_back(leaf);
    return static_cast<int>(trees_[tree].leaves.size()) - 1;
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
    PlannedLeaf leaf{kAbsent, observation, {}};
    leaf.nodes.front() = next_node_++;
    noteUse(observation, context_.first_number + observation);
    trees_.push_back({kNoTree, {leaf}});
    child.leaf_of_tree.push_back(0);
  }

  TrackTree grow(const PlannedTree& plan) {
    TrackTree tree;
    tree.leaves.reserve(plan.leaves.size());
    for (auto leaf = plan.leaves.begin(); leaf != plan.leaves.end(); ++leaf) {
      if (leaf->parent == kAbsent) {
        tree.leaves.push_back({newTarget(leaf->observation), leaf->nodes, {}, {}});
        continue;
      }
      const bool last = std::none_of(leaf + 1, plan.leaves.end(), [&](const PlannedLeaf& other) {
        return other.parent == leaf->parent;
      });
      Leaf& old = old_.trees[plan.old_tree].leaves[static_cast<std::size_t>(leaf->parent)];
      tree.leaves.push_back({last ? std::move(old.target) : old.target, leaf->nodes, {}, {}});
      continueTarget(tree.leaves.back().target, leaf->observation,
                     old.scores.detection_probability);
    }
    return tree;
  }

  Target newTarget(std::size_t observation) const {
    const Object& object = context_.scan.observations[observation].object;
    return {object, observation, context_.first_number + observation, context_.target,
            context_.scan.transitionsOf(object.object_class)};
  }

  void continueTarget(Target& target, std::size_t observation, double seen) const {
    if (observation == kUnseen) {
      target.miss(seen, context_.target);
    } else {
      target.update(context_.scan.observations[observation], observation, seen, context_.target);
    }
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

  HypothesisCluster& old_;
  const ExpansionContext& context_;
  std::uint64_t& next_node_;
  std::size_t& room_;
  AssociationCounts& counts_;
  std::vector<PlannedTree> trees_;  ///< the old ones, then those that start now
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
