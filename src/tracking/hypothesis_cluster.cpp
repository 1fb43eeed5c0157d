// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/tracking/hypothesis_cluster.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <utility>

#include "datmo_fusion/common/disjoint_sets.h"
#include "datmo_fusion/tracking/hypothesis_pruning.h"

namespace datmo {

namespace {

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

void canonicalize(HypothesisCluster& cluster) { canonicalize(cluster.trees, cluster.hypotheses); }

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
