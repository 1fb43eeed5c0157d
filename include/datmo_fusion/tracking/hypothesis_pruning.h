// SPDX-License-Identifier: BSD-3-Clause
// Which hypotheses and leaves of a cluster are kept; for trees whose leaves hold their targets and
// for those whose leaves are only planned: a Tree has `leaves`, a leaf has `nodes` (see Leaf).
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "datmo_fusion/tracking/track_tree.h"

namespace datmo {

/// Sorts by descending weight, and makes weights relative to the best; at least one.
void sortByWeight(std::vector<GlobalHypothesis>& hypotheses);

/// Merges hypotheses that are identical.
void mergeEqual(std::vector<GlobalHypothesis>& hypotheses);

/// Removes the leaves of the `index`-th tree that are in no hypothesis. Returns false if none is
/// left, so that the tree must be removed. `index_of`: memory to be reused.
template <typename Tree>
bool removeUnusedLeaves(Tree& tree, std::size_t index, std::vector<GlobalHypothesis>& hypotheses,
                        std::vector<int>& index_of) {
  if (tree.leaves.size() == 1) {  // the common case
    return std::any_of(hypotheses.begin(), hypotheses.end(), [index](const auto& hypothesis) {
      return hypothesis.leaf_of_tree[index] != kAbsent;
    });
  }
  index_of.assign(tree.leaves.size(), kAbsent);
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
  if (static_cast<std::size_t>(kept) == tree.leaves.size()) {
    return kept > 0;
  }
  tree.leaves.erase(tree.leaves.begin() + kept, tree.leaves.end());
  for (GlobalHypothesis& hypothesis : hypotheses) {
    int& leaf = hypothesis.leaf_of_tree[index];
    leaf = leaf == kAbsent ? kAbsent : index_of[static_cast<std::size_t>(leaf)];
  }
  return kept > 0;
}

/// Sorts the hypotheses, merges equal ones, and removes leaves and trees that are in none, which
/// may be all trees.
template <typename Tree>
void canonicalize(std::vector<Tree>& trees, std::vector<GlobalHypothesis>& hypotheses) {
  std::size_t kept = 0;
  std::vector<int> index_of;
  for (std::size_t tree = 0; tree < trees.size(); ++tree) {
    if (!removeUnusedLeaves(trees[tree], tree, hypotheses, index_of)) {
      continue;
    }
    if (kept != tree) {
      trees[kept] = std::move(trees[tree]);
      for (GlobalHypothesis& hypothesis : hypotheses) {
        hypothesis.leaf_of_tree[kept] = hypothesis.leaf_of_tree[tree];
      }
    }
    ++kept;
  }
  if (kept < trees.size()) {
    trees.erase(trees.begin() + static_cast<std::ptrdiff_t>(kept), trees.end());
    for (GlobalHypothesis& hypothesis : hypotheses) {
      hypothesis.leaf_of_tree.resize(kept);
    }
  }
  mergeEqual(hypotheses);
  sortByWeight(hypotheses);
}

/// Returns what a hypothesis assigned to a target `history` scans ago.
template <typename Tree>
std::uint64_t nodeAt(const std::vector<Tree>& trees, const GlobalHypothesis& hypothesis,
                     std::size_t tree, std::size_t history) {
  const int leaf = hypothesis.leaf_of_tree[tree];
  return leaf == kAbsent ? 0 : trees[tree].leaves[static_cast<std::size_t>(leaf)].nodes[history];
}

/// Removes all hypotheses that differ from the first, the best one, in how they explain the scan
/// `history` scans ago (N-scan pruning: Blackman 2004; thesis 3.3.4). `history`: at most
/// kMaxScanHistory; 0 keeps only the best one.
template <typename Tree>
void pruneHistory(std::vector<Tree>& trees, std::vector<GlobalHypothesis>& hypotheses,
                  std::size_t history) {
  const GlobalHypothesis best = hypotheses.front();
  const auto disagrees = [&](const GlobalHypothesis& hypothesis) {
    for (std::size_t tree = 0; tree < trees.size(); ++tree) {
      if (nodeAt(trees, hypothesis, tree, history) != nodeAt(trees, best, tree, history)) {
        return true;
      }
    }
    return false;
  };
  hypotheses.erase(std::remove_if(hypotheses.begin(), hypotheses.end(), disagrees),
                   hypotheses.end());
  canonicalize(trees, hypotheses);
}

}  // namespace datmo
