// SPDX-License-Identifier: BSD-3-Clause
#include "planned_cluster.h"

#include <algorithm>

#include "datmo_fusion/tracking/hypothesis_pruning.h"

namespace datmo {

PlannedCluster::PlannedCluster(HypothesisCluster& cluster, const ExpansionContext& context,
                               std::uint64_t& next_node, std::size_t& room,
                               AssociationCounts& counts)
    : old_(cluster), context_(context), next_node_(next_node), room_(room), counts_(counts) {
  trees_.reserve(cluster.trees.size());
  for (std::size_t tree = 0; tree < cluster.trees.size(); ++tree) {
    trees_.emplace_back(&memory_).old_tree = tree;
  }
}

void PlannedCluster::add(const RankedHypothesis& source) {
  const std::vector<std::size_t> measurement_index = source.observations();
  if (!hasRoomFor(source.parent(), measurement_index)) {
    ++counts_.cut_hypotheses;
    return;
  }
  GlobalHypothesis child{source.weight(), {}};
  child.leaf_of_tree.reserve(trees_.size());
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

HypothesisCluster PlannedCluster::finish() {
  for (GlobalHypothesis& hypothesis : hypotheses_) {
    hypothesis.leaf_of_tree.resize(trees_.size(), kAbsent);
  }
  canonicalize(trees_, hypotheses_);
  if (hypotheses_.size() > 1) {
    pruneHistory(trees_, hypotheses_, static_cast<std::size_t>(context_.options.scan_history));
  }
  HypothesisCluster result{{}, std::move(hypotheses_), std::move(old_.links), {}};
  linkSharers(result);
  result.trees.reserve(trees_.size());
  for (const PlannedTree& plan : trees_) {
    result.trees.push_back(grow(plan));
  }
  return result;
}

int PlannedCluster::find(std::size_t tree, int parent, std::size_t observation) const {
  const auto& leaves = trees_[tree].leaves;
  const auto found = std::find_if(leaves.begin(), leaves.end(), [&](const PlannedLeaf& leaf) {
    return leaf.parent == parent && leaf.observation == observation;
  });
  return found == leaves.end() ? kAbsent : static_cast<int>(found - leaves.begin());
}

bool PlannedCluster::hasRoomFor(const GlobalHypothesis& parent,
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

int PlannedCluster::leafFor(std::size_t tree, int parent, std::size_t observation) {
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

void PlannedCluster::startTarget(std::size_t observation, GlobalHypothesis& child) {
  if (!context_.scan.observations[observation].startsTarget()) {
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
  trees_.emplace_back(&memory_).leaves.push_back(leaf);
  child.leaf_of_tree.push_back(0);
}

TrackTree PlannedCluster::grow(const PlannedTree& plan) {
  TrackTree tree;
  if (plan.old_tree != kNoTree && plan.leaves.size() == 1 &&
      old_.trees[plan.old_tree].leaves.size() == 1) {
    tree = std::move(old_.trees[plan.old_tree]);  // most do not branch: reuse the target
    Leaf& leaf = tree.leaves.front();
    leaf.nodes = plan.leaves.front().nodes;
    continueTarget(leaf.target, plan.leaves.front().observation, leaf.scores.detection_probability);
    return tree;
  }
  tree.leaves.reserve(plan.leaves.size());
  for (auto leaf = plan.leaves.begin(); leaf != plan.leaves.end(); ++leaf) {
    if (leaf->parent == kAbsent) {
      startTarget(*leaf, tree);
      continue;
    }
    const bool last = std::none_of(leaf + 1, plan.leaves.end(), [&](const PlannedLeaf& other) {
      return other.parent == leaf->parent;
    });
    Leaf& old = old_.trees[plan.old_tree].leaves[static_cast<std::size_t>(leaf->parent)];
    if (last) {
      tree.leaves.emplace_back(leaf->nodes, std::move(old.target));
    } else {
      tree.leaves.emplace_back(leaf->nodes, old.target);
    }
    continueTarget(tree.leaves.back().target, leaf->observation, old.scores.detection_probability);
  }
  return tree;
}

void PlannedCluster::startTarget(const PlannedLeaf& leaf, TrackTree& tree) const {
  const Object& object = context_.scan.observations[leaf.observation].object;
  tree.leaves.emplace_back(leaf.nodes, object, leaf.observation,
                           context_.first_number + leaf.observation, context_.target,
                           context_.scan.transitionsOf(object.objectClass()));
}

void PlannedCluster::continueTarget(Target& target, std::size_t observation, double seen) const {
  if (observation == kUnseen) {
    target.miss(seen, context_.target);
  } else {
    target.update(context_.scan.observations[observation], observation, seen, context_.target);
  }
}

void PlannedCluster::noteUse(std::size_t observation, std::uint64_t number) {
  for (const std::size_t source : context_.scan.observations[observation].sources) {
    uses_.push_back({source, number});
  }
}

/// Links targets that may share an object: they depend on each other.
void PlannedCluster::linkSharers(HypothesisCluster& cluster) {
  std::sort(uses_.begin(), uses_.end());
  uses_.erase(std::unique(uses_.begin(), uses_.end()), uses_.end());
  auto first = uses_.begin();
  for (auto use = uses_.begin(); use != uses_.end(); ++use) {
    if (use->first != first->first) {
      first = use;
    } else if (use != first) {
      cluster.links.push_back({context_.scan_number, first->second, use->second});
    }
  }
}

}  // namespace datmo
