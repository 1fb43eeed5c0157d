// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/tracking/hypothesis_cluster.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <numeric>
#include <tuple>
#include <utility>

#include "datmo_fusion/common/disjoint_sets.h"

namespace datmo {

namespace {

bool isBetter(const GlobalHypothesis& a, const GlobalHypothesis& b) {
  return std::make_tuple(-a.log_weight, std::cref(a.leaf_of_tree)) <
         std::make_tuple(-b.log_weight, std::cref(b.leaf_of_tree));
}

/// Of two sums of probabilities given by their logarithms.
double logSum(double a, double b) {
  const double largest = std::max(a, b);
  return largest + std::log1p(std::exp(std::min(a, b) - largest));
}

/// Hypotheses that say the same become one.
void mergeEqual(std::vector<GlobalHypothesis>& hypotheses) {
  std::map<std::vector<int>, double> weights;
  for (const GlobalHypothesis& hypothesis : hypotheses) {
    const auto found = weights.emplace(hypothesis.leaf_of_tree, hypothesis.log_weight);
    if (!found.second) {
      found.first->second = logSum(found.first->second, hypothesis.log_weight);
    }
  }
  if (weights.size() < hypotheses.size()) {
    hypotheses.clear();
    for (const auto& entry : weights) {
      hypotheses.push_back({entry.second, entry.first});
    }
  }
}

void sortByWeight(std::vector<GlobalHypothesis>& hypotheses) {
  std::sort(hypotheses.begin(), hypotheses.end(), isBetter);
  const double best = hypotheses.front().log_weight;
  for (GlobalHypothesis& hypothesis : hypotheses) {
    hypothesis.log_weight -= best;
  }
}

/// Removes the leaves of a tree, the `tree`-th, that are in no hypothesis. Returns whether any is
/// left.
bool removeUnusedLeaves(TrackTree& tree, std::size_t index,
                        std::vector<GlobalHypothesis>& hypotheses) {
  std::vector<int> index_of(tree.leaves.size(), kAbsent);
  for (const GlobalHypothesis& hypothesis : hypotheses) {
    const int leaf = hypothesis.leaf_of_tree[index];
    if (leaf != kAbsent) {
      index_of[static_cast<std::size_t>(leaf)] = 0;
    }
  }
  int kept = 0;
  for (std::size_t leaf = 0; leaf < index_of.size(); ++leaf) {
    if (index_of[leaf] != kAbsent) {
      index_of[leaf] = kept;
      if (static_cast<std::size_t>(kept) != leaf) {
        tree.leaves[static_cast<std::size_t>(kept)] = std::move(tree.leaves[leaf]);
      }
      ++kept;
    }
  }
  tree.leaves.erase(tree.leaves.begin() + kept, tree.leaves.end());
  for (GlobalHypothesis& hypothesis : hypotheses) {
    int& leaf = hypothesis.leaf_of_tree[index];
    leaf = leaf == kAbsent ? kAbsent : index_of[static_cast<std::size_t>(leaf)];
  }
  return kept > 0;
}

/// What a hypothesis assigned to a target `history` scans ago.
std::uint64_t nodeAt(const HypothesisCluster& cluster, const GlobalHypothesis& hypothesis,
                     std::size_t tree, std::size_t history) {
  const int leaf = hypothesis.leaf_of_tree[tree];
  return leaf == kAbsent
             ? 0
             : cluster.trees[tree].leaves[static_cast<std::size_t>(leaf)].nodes[history];
}

/// Takes the trees of these indices out, with the weights that the hypotheses give them alone.
HypothesisCluster part(HypothesisCluster& cluster, const std::vector<std::size_t>& trees) {
  HypothesisCluster result;
  for (const std::size_t tree : trees) {
    result.trees.push_back(std::move(cluster.trees[tree]));
  }
  for (const GlobalHypothesis& whole : cluster.hypotheses) {
    GlobalHypothesis hypothesis{whole.log_weight, {}};
    for (const std::size_t tree : trees) {
      hypothesis.leaf_of_tree.push_back(whole.leaf_of_tree[tree]);
    }
    result.hypotheses.push_back(std::move(hypothesis));
  }
  canonicalize(result);
  return result;
}

}  // namespace

std::vector<double> HypothesisCluster::probabilities() const {
  std::vector<double> result;
  double sum = 0.0;
  for (const GlobalHypothesis& hypothesis : hypotheses) {
    result.push_back(std::exp(hypothesis.log_weight));
    sum += result.back();
  }
  for (double& probability : result) {
    probability /= sum;
  }
  return result;
}

HypothesisCluster singleTarget(TrackTree tree) {
  HypothesisCluster cluster;
  cluster.trees.push_back(std::move(tree));
  cluster.hypotheses.push_back({0.0, {0}});
  return cluster;
}

HypothesisCluster merge(HypothesisCluster a, HypothesisCluster b, std::size_t max) {
  HypothesisCluster result;
  result.trees = std::move(a.trees);
  std::move(b.trees.begin(), b.trees.end(), std::back_inserter(result.trees));
  result.links = std::move(a.links);
  result.links.insert(result.links.end(), b.links.begin(), b.links.end());
  for (const GlobalHypothesis& first : a.hypotheses) {
    for (const GlobalHypothesis& second : b.hypotheses) {
      GlobalHypothesis both = first;
      both.log_weight += second.log_weight;
      both.leaf_of_tree.insert(both.leaf_of_tree.end(), second.leaf_of_tree.begin(),
                               second.leaf_of_tree.end());
      result.hypotheses.push_back(std::move(both));
    }
  }
  sortByWeight(result.hypotheses);
  if (result.hypotheses.size() > max) {
    result.hypotheses.resize(max);
    canonicalize(result);
  }
  return result;
}

void pruneHistory(HypothesisCluster& cluster, std::size_t history) {
  const GlobalHypothesis best = cluster.best();
  const auto disagrees = [&](const GlobalHypothesis& hypothesis) {
    for (std::size_t tree = 0; tree < cluster.trees.size(); ++tree) {
      if (nodeAt(cluster, hypothesis, tree, history) != nodeAt(cluster, best, tree, history)) {
        return true;
      }
    }
    return false;
  };
  auto& hypotheses = cluster.hypotheses;
  hypotheses.erase(std::remove_if(hypotheses.begin(), hypotheses.end(), disagrees),
                   hypotheses.end());
  canonicalize(cluster);
}

void removeLeaves(HypothesisCluster& cluster, const std::function<bool(const Target&)>& isLost) {
  bool changed = false;
  for (std::size_t tree = 0; tree < cluster.trees.size(); ++tree) {
    const std::vector<Leaf>& leaves = cluster.trees[tree].leaves;
    for (std::size_t leaf = 0; leaf < leaves.size(); ++leaf) {
      if (!isLost(leaves[leaf].target)) {
        continue;
      }
      changed = true;
      for (GlobalHypothesis& hypothesis : cluster.hypotheses) {
        int& used = hypothesis.leaf_of_tree[tree];
        used = used == static_cast<int>(leaf) ? kAbsent : used;
      }
    }
  }
  if (changed) {
    canonicalize(cluster);
  }
}

void canonicalize(HypothesisCluster& cluster) {
  std::size_t kept = 0;
  std::vector<std::size_t> trees;
  for (std::size_t tree = 0; tree < cluster.trees.size(); ++tree) {
    if (removeUnusedLeaves(cluster.trees[tree], tree, cluster.hypotheses)) {
      trees.push_back(tree);
    }
  }
  if (trees.size() < cluster.trees.size()) {
    for (const std::size_t tree : trees) {
      if (kept != tree) {
        cluster.trees[kept] = std::move(cluster.trees[tree]);
      }
      for (GlobalHypothesis& hypothesis : cluster.hypotheses) {
        hypothesis.leaf_of_tree[kept] = hypothesis.leaf_of_tree[tree];
      }
      ++kept;
    }
    cluster.trees.erase(cluster.trees.begin() + static_cast<std::ptrdiff_t>(kept),
                        cluster.trees.end());
    for (GlobalHypothesis& hypothesis : cluster.hypotheses) {
      hypothesis.leaf_of_tree.resize(kept);
    }
  }
  mergeEqual(cluster.hypotheses);
  sortByWeight(cluster.hypotheses);
}

std::vector<HypothesisCluster> split(HypothesisCluster cluster, std::uint64_t oldest_scan) {
  std::vector<TreeLink>& links = cluster.links;
  links.erase(std::remove_if(links.begin(), links.end(),
                             [&](const TreeLink& link) { return link.scan < oldest_scan; }),
              links.end());
  // Targets that are gone still link those that are left: they come after these.
  std::map<std::uint64_t, std::size_t> index_of;
  for (const TrackTree& tree : cluster.trees) {
    index_of.emplace(tree.number(), index_of.size());
  }
  for (const TreeLink& link : links) {
    index_of.emplace(link.first, index_of.size());
    index_of.emplace(link.second, index_of.size());
  }
  DisjointSets groups(index_of.size());
  for (const TreeLink& link : links) {
    groups.join(index_of[link.first], index_of[link.second]);
  }
  std::vector<HypothesisCluster> result;
  for (std::vector<std::size_t>& group : groups.sets()) {
    const std::size_t first = group.front();
    group.erase(std::lower_bound(group.begin(), group.end(), cluster.trees.size()), group.end());
    if (group.size() == cluster.trees.size() && !group.empty()) {
      return {std::move(cluster)};
    }
    if (group.empty()) {
      continue;
    }
    result.push_back(part(cluster, group));
    std::copy_if(links.begin(), links.end(), std::back_inserter(result.back().links),
                 [&](const TreeLink& link) { return groups.find(index_of[link.first]) == first; });
  }
  return result;
}

}  // namespace datmo
