// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "datmo_fusion/tracking/track_tree.h"

namespace datmo {

/// Two targets that may share an object.
struct TreeLink {
  std::uint64_t scan;  ///< counted from the first one
  std::uint64_t first;
  std::uint64_t second;  ///< numbers of the targets
};

/// Targets that compete for objects, and the hypotheses about all of them together (Reid 1979;
/// Cox and Hingorani 1996). Different clusters are decided independently.
struct HypothesisCluster {
  std::vector<TrackTree> trees;
  std::vector<GlobalHypothesis> hypotheses;  ///< best first; at least one
  std::vector<TreeLink> links;
  /// The objects of the current scan that any leaf may be associated with, whole or in part,
  /// ascending.
  std::vector<std::size_t> objects;

  const GlobalHypothesis& best() const { return hypotheses.front(); }

  /// Returns the probability of each hypothesis; they sum to 1.
  std::vector<double> probabilities() const;
};

/// Returns a cluster of a single target that was just detected for the first time.
HypothesisCluster singleTarget(TrackTree tree);

/// Merges another cluster into this one, keeping the `max` (1 or more) most likely pairs of their
/// hypotheses. The clusters have no target in common, and at least one hypothesis each, sorted and
/// without unused leaves (canonicalize). The `objects` must be determined again: those of the first
/// one are kept.
void merge(HypothesisCluster other, std::size_t max, HypothesisCluster& cluster);

/// Removes leaves for which `isLost` is true, in all hypotheses.
void removeLeaves(HypothesisCluster& cluster, const std::function<bool(const Target&)>& isLost);

/// Sorts the hypotheses, merges equal ones, and removes leaves and trees that are in none. A
/// cluster may be left without trees.
void canonicalize(HypothesisCluster& cluster);

/// Adds to `parts`, as separate clusters, the groups of targets that have shared no object since
/// `oldest_scan`, not even through a target that no longer exists.
void split(HypothesisCluster cluster, std::uint64_t oldest_scan,
           std::vector<HypothesisCluster>& parts);

}  // namespace datmo
