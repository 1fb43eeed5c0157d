// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/tracking/hypothesis_cluster.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <iterator>
#include <tuple>
#include <utility>

#include "datmo_fusion/common/disjoint_sets.h"
#include "datmo_fusion/tracking/hypothesis_pruning.h"

namespace datmo {

namespace {

/// Extracts the trees of these indices, with the weights that the hypotheses give to them alone.
HypothesisCluster part(HypothesisCluster& cluster, const std::vector<std::size_t>& trees) {
  HypothesisCluster result;
  result.trees.reserve(trees.size());
  for (const std::size_t tree : trees) {
    result.trees.push_back(std::move(cluster.trees[tree]));
  }
  result.hypotheses.reserve(cluster.hypotheses.size());
  for (const GlobalHypothesis& whole : cluster.hypotheses) {
    GlobalHypothesis hypothesis{whole.log_weight, {}};
    hypothesis.leaf_of_tree.reserve(trees.size());
    for (const std::size_t tree : trees) {
      hypothesis.leaf_of_tree.push_back(whole.leaf_of_tree[tree]);
    }
    result.hypotheses.push_back(std::move(hypothesis));
  }
  canonicalize(result);
  return result;
}

/// Assigns indices from 0 on to targets, by their numbers, in the order in which they are added.
class NumberIndex {
 public:
  /// `max`: capacity.
  explicit NumberIndex(std::size_t max) { entries_.reserve(max); }

  void add(std::uint64_t number) {
    const auto found = lowerBound(number);
    if (found == entries_.end() || found->first != number) {
      entries_.insert(found, {number, entries_.size()});
    }
  }

  /// Returns the index of a number that was added.
  std::size_t operator[](std::uint64_t number) { return lowerBound(number)->second; }
  std::size_t size() const { return entries_.size(); }

 private:
  using Entry = std::pair<std::uint64_t, std::size_t>;

  std::vector<Entry>::iterator lowerBound(std::uint64_t number) {
    return std::lower_bound(entries_.begin(), entries_.end(), Entry{number, 0});
  }

  std::vector<Entry> entries_;  ///< by number
};

/// One hypothesis of each of two clusters, by their indices.
struct HypothesisPair {
  double log_weight;
  std::size_t first;
  std::size_t second;
};

/// All pairs are sorted, but only those that are kept are built: of ten hypotheses each, a tenth.
std::vector<GlobalHypothesis> likeliestPairs(const std::vector<GlobalHypothesis>& a,
                                             const std::vector<GlobalHypothesis>& b,
                                             std::size_t max) {
  std::vector<HypothesisPair> pairs;
  pairs.reserve(a.size() * b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j < b.size(); ++j) {
      pairs.push_back({a[i].log_weight + b[j].log_weight, i, j});
    }
  }
  const std::size_t kept = std::min(pairs.size(), max);
  const auto end = pairs.begin() + static_cast<std::ptrdiff_t>(kept);
  std::partial_sort(
      pairs.begin(), end, pairs.end(),
      [&](const HypothesisPair& left, const HypothesisPair& right) {
        // The same order as in sortByWeight().
        return std::tie(right.log_weight, a[left.first].leaf_of_tree, b[left.second].leaf_of_tree) <
               std::tie(left.log_weight, a[right.first].leaf_of_tree, b[right.second].leaf_of_tree);
      });
  std::vector<GlobalHypothesis> result;
  result.reserve(kept);
  for (auto pair = pairs.begin(); pair != end; ++pair) {
    const std::vector<int>& first = a[pair->first].leaf_of_tree;
    const std::vector<int>& second = b[pair->second].leaf_of_tree;
    GlobalHypothesis both{pair->log_weight - pairs.front().log_weight, {}};
    both.leaf_of_tree.reserve(first.size() + second.size());
    both.leaf_of_tree.insert(both.leaf_of_tree.end(), first.begin(), first.end());
    both.leaf_of_tree.insert(both.leaf_of_tree.end(), second.begin(), second.end());
    result.push_back(std::move(both));
  }
  return result;
}

/// Adds another cluster's only hypothesis to all of these: their order and weights stay.
void append(const GlobalHypothesis& other, std::vector<GlobalHypothesis>& hypotheses) {
  for (GlobalHypothesis& hypothesis : hypotheses) {
    hypothesis.leaf_of_tree.insert(hypothesis.leaf_of_tree.end(), other.leaf_of_tree.begin(),
                                   other.leaf_of_tree.end());
  }
}

[[maybe_unused]] bool isSorted(const HypothesisCluster& cluster) {
  return !cluster.hypotheses.empty() &&
         std::is_sorted(cluster.hypotheses.begin(), cluster.hypotheses.end(),
                        [](const GlobalHypothesis& better, const GlobalHypothesis& worse) {
                          return better.log_weight > worse.log_weight;
                        });
}

[[maybe_unused]] bool haveCommonTarget(const HypothesisCluster& a, const HypothesisCluster& b) {
  return std::any_of(a.trees.begin(), a.trees.end(), [&b](const TrackTree& one) {
    return std::any_of(b.trees.begin(), b.trees.end(),
                       [&one](const TrackTree& other) { return one.number() == other.number(); });
  });
}

}  // namespace

std::vector<double> HypothesisCluster::probabilities() const {
  std::vector<double> result;
  result.reserve(hypotheses.size());
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

void merge(HypothesisCluster other, std::size_t max, HypothesisCluster& cluster) {
  assert(max > 0 && isSorted(cluster) && isSorted(other) && !haveCommonTarget(cluster, other));
  const std::size_t pairs = cluster.hypotheses.size() * other.hypotheses.size();
  if (other.hypotheses.size() == 1 && pairs <= max) {
    append(other.hypotheses.front(), cluster.hypotheses);  // the common case: nothing to decide
  } else {
    cluster.hypotheses = likeliestPairs(cluster.hypotheses, other.hypotheses, max);
  }
  std::move(other.trees.begin(), other.trees.end(), std::back_inserter(cluster.trees));
  cluster.links.insert(cluster.links.end(), other.links.begin(), other.links.end());
  if (cluster.hypotheses.size() < pairs) {
    canonicalize(cluster);
  }
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

void split(HypothesisCluster cluster, std::uint64_t oldest_scan,
           std::vector<HypothesisCluster>& parts) {
  std::vector<TreeLink>& links = cluster.links;
  links.erase(std::remove_if(links.begin(), links.end(),
                             [&](const TreeLink& link) { return link.scan < oldest_scan; }),
              links.end());
  if (cluster.trees.size() == 1) {
    parts.push_back(std::move(cluster));
    return;
  }
  // Targets that no longer exist still link the remaining ones: they are indexed after these.
  NumberIndex index_of(cluster.trees.size() + 2 * links.size());
  for (const TrackTree& tree : cluster.trees) {
    index_of.add(tree.number());
  }
  for (const TreeLink& link : links) {
    index_of.add(link.first);
    index_of.add(link.second);
  }
  DisjointSets groups(index_of.size());
  for (const TreeLink& link : links) {
    groups.join(index_of[link.first], index_of[link.second]);
  }
  for (std::vector<std::size_t>& group : groups.sets()) {
    const std::size_t first = group.front();
    group.erase(std::lower_bound(group.begin(), group.end(), cluster.trees.size()), group.end());
    if (group.size() == cluster.trees.size() && !group.empty()) {
      parts.push_back(std::move(cluster));
      return;
    }
    if (group.empty()) {
      continue;
    }
    parts.push_back(part(cluster, group));
    std::copy_if(links.begin(), links.end(), std::back_inserter(parts.back().links),
                 [&](const TreeLink& link) { return groups.find(index_of[link.first]) == first; });
  }
}

}  // namespace datmo
