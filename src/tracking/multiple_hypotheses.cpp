// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/tracking/multiple_hypotheses.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "datmo_fusion/common/disjoint_sets.h"

namespace datmo {

namespace {

/// See HypothesisCluster::objects.
void findObjects(HypothesisCluster& cluster) {
  std::vector<std::size_t>& objects = cluster.objects;
  std::size_t all = 0;
  for (const TrackTree& tree : cluster.trees) {
    for (const Leaf& leaf : tree.leaves) {
      all += leaf.scores.candidates.size() + leaf.related.size();
    }
  }
  objects.clear();
  objects.reserve(all);
  for (const TrackTree& tree : cluster.trees) {
    for (const Leaf& leaf : tree.leaves) {
      for (const Candidate& candidate : leaf.scores.candidates) {
        objects.push_back(candidate.observation);
      }
      objects.insert(objects.end(), leaf.related.begin(), leaf.related.end());
    }
  }
  std::sort(objects.begin(), objects.end());
  objects.erase(std::unique(objects.begin(), objects.end()), objects.end());
}

/// A single target without any open decision or nearby object: most targets that false alarms have
/// started are like this.
bool isUnseenSingle(const HypothesisCluster& cluster) {
  return cluster.trees.size() == 1 && cluster.hypotheses.size() == 1 &&
         cluster.trees.front().leaves.size() == 1 && cluster.objects.empty();
}

}  // namespace

MultipleHypotheses::MultipleHypotheses(const TargetOptions& target,
                                       const AssociationOptions& association,
                                       const HypothesisOptions& hypotheses,
                                       const SplitMergeOptions& split_merge)
    : target_options_(target),
      steps_(target.filter),
      options_(association),
      hypothesis_options_(hypotheses),
      split_merge_(split_merge) {}

std::unique_ptr<TargetSet> MultipleHypotheses::clone() const {
  auto copy = std::make_unique<MultipleHypotheses>(*this);
  copy->best_known_ = false;  // it points to its own targets
  return copy;
}

void MultipleHypotheses::predict(double seconds, const AssociationScan& scan) {
  const ImmSteps& steps = steps_.of(seconds);
  for (HypothesisCluster& cluster : clusters_) {
    for (TrackTree& tree : cluster.trees) {
      for (Leaf& leaf : tree.leaves) {
        leaf.target.predict(seconds, steps, target_options_);
        const double existence = leaf.target.existenceProbability(target_options_);
        leaf.scores = scoresOf(leaf.target, scan, existence, options_, std::move(leaf.scores));
        leaf.related = relatedObjects(leaf.target, scan, split_merge_, std::move(leaf.related));
      }
    }
  }
}

void MultipleHypotheses::associate(AssociationScan& scan, const StepBudget& budget) {
  best_known_ = false;
  const std::uint64_t best_only_before = counts_.best_only_steps;
  mergeCompeting(scan.objects);
  const std::size_t followed = targets();
  const auto max = static_cast<std::size_t>(options_.max_targets);
  room_ = followed < max ? max - followed : 0;

  std::vector<bool> claimed(scan.objects, false);
  std::vector<HypothesisCluster> next;
  next.reserve(clusters_.size() + scan.objects);
  for (HypothesisCluster& cluster : clusters_) {
    for (const std::size_t object : cluster.objects) {
      claimed[object] = true;
    }
    expandCluster(std::move(cluster), scan, budget, next);
  }
  startTargets(scan, claimed, next);
  clusters_ = std::move(next);
  next_number_ += scan.objects;
  ++scan_number_;
  counts_.best_only_steps = std::min(counts_.best_only_steps, best_only_before + 1);
}

/// Merges clusters whose targets may share an object.
void MultipleHypotheses::mergeCompeting(std::size_t objects) {
  constexpr std::size_t kUnclaimed = kUnseen;
  std::vector<std::size_t> claimer(objects, kUnclaimed);
  DisjointSets groups(clusters_.size());
  for (std::size_t i = 0; i < clusters_.size(); ++i) {
    findObjects(clusters_[i]);
    for (const std::size_t object : clusters_[i].objects) {
      if (claimer[object] == kUnclaimed) {
        claimer[object] = i;
      } else {
        groups.join(claimer[object], i);
      }
    }
  }
  const auto max = static_cast<std::size_t>(hypothesis_options_.max_hypotheses);
  for (const std::vector<std::size_t>& group : groups.sets(2)) {
    HypothesisCluster& all = clusters_[group.front()];
    for (std::size_t i = 1; i < group.size(); ++i) {
      merge(std::exchange(clusters_[group[i]], HypothesisCluster()), max, all);
    }
    findObjects(all);  // leaves may have been removed
  }
  removeEmpty();
}

void MultipleHypotheses::removeEmpty() {
  clusters_.erase(
      std::remove_if(clusters_.begin(), clusters_.end(),
                     [](const HypothesisCluster& cluster) { return cluster.trees.empty(); }),
      clusters_.end());
}

void MultipleHypotheses::expandCluster(HypothesisCluster cluster, AssociationScan& scan,
                                       const StepBudget& budget,
                                       std::vector<HypothesisCluster>& next) {
  const bool late = budget.isSpent();
  counts_.best_only_steps += late ? 1 : 0;
  if (isUnseenSingle(cluster)) {
    missSingle(cluster);
    next.push_back(std::move(cluster));
    return;
  }
  const bool best_only = late || cluster.trees.size() > static_cast<std::size_t>(
                                                            hypothesis_options_.max_joint_targets);
  std::vector<Interpretation> interpretations{cluster.objects};
  if (!best_only) {
    addSplitAndMerged(cluster, scan, options_, split_merge_, interpretations);
  }
  const ExpansionContext context{scan,         target_options_, hypothesis_options_, scan_number_,
                                 next_number_, best_only,       options_.max_work};
  HypothesisCluster whole =
      expand(std::move(cluster), interpretations, context, next_node_, room_, counts_);
  const bool decided = whole.hypotheses.size() == 1;
  const auto history = static_cast<std::uint64_t>(hypothesis_options_.scan_history);
  const std::uint64_t open = decided ? 0 : history;  // scans with open decisions
  const std::uint64_t oldest = scan_number_ + 1 > open ? scan_number_ + 1 - open : 0;
  split(std::move(whole), oldest, next);
}

/// Same result as expand() and split().
void MultipleHypotheses::missSingle(HypothesisCluster& cluster) {
  Leaf& leaf = cluster.trees.front().leaves.front();
  std::copy_backward(leaf.nodes.begin(), leaf.nodes.end() - 1, leaf.nodes.end());
  leaf.nodes.front() = next_node_++;
  leaf.target.miss(leaf.scores.detection_probability, target_options_);
  cluster.hypotheses.front().log_weight = 0.0;
  cluster.links.clear();
}

void MultipleHypotheses::startTargets(const AssociationScan& scan, const std::vector<bool>& claimed,
                                      std::vector<HypothesisCluster>& next) {
  for (std::size_t object = 0; object < scan.objects; ++object) {
    const Observation& observation = scan.observations[object];
    if (claimed[object] || !observation.startsTarget()) {
      continue;
    }
    if (room_ == 0) {
      ++counts_.refused_births;
      continue;
    }
    --room_;
    TrackTree tree;
    tree.leaves.emplace_back(Leaf::Nodes{next_node_++}, observation.object, object,
                             next_number_ + object, target_options_,
                             scan.transitionsOf(observation.object.objectClass()));
    next.push_back(singleTarget(std::move(tree)));
  }
}

const std::vector<BestTarget>& MultipleHypotheses::best() const {
  if (!best_known_) {
    findBest();
    best_known_ = true;
  }
  return best_;
}

void MultipleHypotheses::findBest() const {
  best_.clear();
  for (const HypothesisCluster& cluster : clusters_) {
    if (cluster.hypotheses.size() == 1) {
      for (const TrackTree& tree : cluster.trees) {
        assert(tree.leaves.size() == 1);
        best_.push_back({&tree.leaves.front().target, 1.0});
      }
      continue;
    }
    const std::vector<double> probabilities = cluster.probabilities();
    for (std::size_t tree = 0; tree < cluster.trees.size(); ++tree) {
      const int leaf = cluster.best().leaf_of_tree[tree];
      if (leaf == kAbsent) {
        continue;
      }
      double present = 0.0;
      for (std::size_t i = 0; i < probabilities.size(); ++i) {
        present += cluster.hypotheses[i].leaf_of_tree[tree] == kAbsent ? 0.0 : probabilities[i];
      }
      best_.push_back(
          {&cluster.trees[tree].leaves[static_cast<std::size_t>(leaf)].target, present});
    }
  }
  std::sort(best_.begin(), best_.end(), [](const BestTarget& a, const BestTarget& b) {
    return a.target->number() < b.target->number();
  });
}

void MultipleHypotheses::change(std::uint64_t number, const std::function<void(Target&)>& change) {
  for (HypothesisCluster& cluster : clusters_) {
    for (TrackTree& tree : cluster.trees) {
      if (tree.number() == number) {
        for (Leaf& leaf : tree.leaves) {
          change(leaf.target);
        }
        return;
      }
    }
  }
}

void MultipleHypotheses::removeIf(const std::function<bool(const Target&)>& isLost) {
  bool any = false;
  const auto note = [&](const Target& target) {
    const bool lost = isLost(target);
    any = any || lost;
    return lost;
  };
  for (HypothesisCluster& cluster : clusters_) {
    removeLeaves(cluster, note);
  }
  if (!any) {
    return;
  }
  best_known_ = false;
  removeEmpty();
}

std::size_t MultipleHypotheses::targets() const {
  std::size_t result = 0;
  for (const HypothesisCluster& cluster : clusters_) {
    result += cluster.trees.size();
  }
  return result;
}

}  // namespace datmo
