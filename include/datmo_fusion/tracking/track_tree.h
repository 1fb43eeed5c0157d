// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "datmo_fusion/tracking/association.h"
#include "datmo_fusion/tracking/target.h"

namespace datmo {

/// Maximum number of scans back to which the branches of a track tree can be distinguished.
inline constexpr std::size_t kMaxScanHistory = 8;

/// One sequence of observations of a target until now: a leaf of its track tree.
///
/// The tree itself is not stored. A leaf knows its own node and those of the last scans, newest
/// first; 0: before the target was first detected.
struct Leaf {
  using Nodes = std::array<std::uint64_t, kMaxScanHistory + 1>;

  /// Constructs its target in place: it is large.
  template <typename... OfTarget>
  explicit Leaf(const Nodes& all_nodes, OfTarget&&... of_target)
      : target(std::forward<OfTarget>(of_target)...), nodes(all_nodes) {}

  Target target;
  Nodes nodes;
  TargetScores scores;               ///< for the current scan
  std::vector<std::size_t> related;  ///< objects; see relatedObjects()
};

/// All observation sequences of one target; at least one.
struct TrackTree {
  std::vector<Leaf> leaves;

  std::uint64_t number() const { return leaves.front().target.number(); }
};

/// The target does not exist in this hypothesis: its objects belong to others.
inline constexpr int kAbsent = -1;

/// One explanation of all objects of a cluster: a leaf, or none, for each of its trees.
struct GlobalHypothesis {
  double log_weight = 0.0;  ///< relative to the best of its cluster
  std::vector<int> leaf_of_tree;
};

}  // namespace datmo
