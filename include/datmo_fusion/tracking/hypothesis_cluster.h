// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "datmo_fusion/tracking/track_tree.h"

namespace datmo {

/// Two targets that may have been seen as the same object.
struct TreeLink {
  std::uint64_t scan;  ///< counted from the first one
  std::uint64_t first;
  std::uint64_t second;  ///< numbers of the targets
};

/// Targets that compete for objects, and the hypotheses about all of them together (Reid 1979;
/// Cox and Hingorani 1996). What two clusters decide does not depend on each other.
struct HypothesisCluster {
  std::vector<TrackTree> trees;
  std::vector<GlobalHypothesis> hypotheses;  ///< the best first; at least one
  std::vector<TreeLink> links;
  /// The objects of the present scan that any leaf may have been seen as, whole or in part, rising.
  std::vector<std::size_t> objects;

  const GlobalHypothesis& best() const { return hypotheses.front(); }

  /// Probability of each hypothesis; they sum to 1.
  std::vector<double> probabilities() const;
};

/// A cluster of one target that has just been seen for the first time.
HypothesisCluster singleTarget(TrackTree tree);

/// Both clusters as one, with the `max` (1 or more) likeliest pairs of their hypotheses. The
/// clusters have no target in common, and at least one hypothesis each, sorted and without leaves
/// that are in none (canonicalize). Their `objects` are to be found anew: those of the first one
/// stay.
HypothesisCluster merge(HypothesisCluster a, HypothesisCluster b, std::size_t max);

/// Removes leaves of which this is true, in all hypotheses.
void removeLeaves(HypothesisCluster& cluster, const std::function<bool(const Target&)>& isLost);

/// Sorts the hypotheses, merges equal ones, and removes leaves and trees that are in none. A
/// cluster may be left without trees.
void canonicalize(HypothesisCluster& cluster);

/// Adds to `parts` the groups of targets that have shared no object since `oldest_scan`, not even
/// through one that is gone, as clusters of their own.
void split(HypothesisCluster cluster, std::uint64_t oldest_scan,
           std::vector<HypothesisCluster>& parts);

}  // namespace datmo
