// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <memory_resource>
#include <set>
#include <utility>
#include <vector>

#include "ranked_hypothesis.h"

#include "datmo_fusion/tracking/hypothesis_cluster.h"
#include "datmo_fusion/tracking/hypothesis_expansion.h"

namespace datmo {

/// Of new targets.
inline constexpr std::size_t kNoTree = std::numeric_limits<std::size_t>::max();

/// A leaf of the next scan before its target is made: many of those that hypotheses ask for do not
/// outlive the pruning, and a target is costly to update.
struct PlannedLeaf {
  int parent;               ///< leaf of the old tree that it continues; kAbsent: a new target
  std::size_t observation;  ///< kUnseen: missed
  Leaf::Nodes nodes;        ///< see Leaf
};

struct PlannedTree {
  explicit PlannedTree(std::pmr::memory_resource* memory) : leaves(memory) {}

  std::size_t old_tree = kNoTree;  ///< that it continues
  std::pmr::vector<PlannedLeaf> leaves;
};

/// The cluster of the next scan, as its hypotheses come in. All that it is made of must outlive it.
class PlannedCluster {
 public:
  /// `cluster`: the old one, of which finish() takes the targets. `room`, `counts`: see expand().
  PlannedCluster(HypothesisCluster& cluster, const ExpansionContext& context,
                 std::uint64_t& next_node, std::size_t& room, AssociationCounts& counts);

  /// Adds the present assignment of a source, unless it needs more leaves than there may be.
  void add(const RankedHypothesis& source);

  std::size_t size() const { return hypotheses_.size(); }

  /// Logarithm; of at least one.
  double bestWeight() const { return hypotheses_.front().log_weight; }

  /// Prunes, and makes the targets of what is left, out of the old ones: to be called last.
  HypothesisCluster finish();

 private:
  /// Memory of the leaves of most clusters, bytes; for larger ones more is taken when needed.
  static constexpr std::size_t kFirstMemory = 4096;

  int find(std::size_t tree, int parent, std::size_t observation) const;
  bool hasRoomFor(const GlobalHypothesis& parent,
                  const std::vector<std::size_t>& measurement_index) const;
  int leafFor(std::size_t tree, int parent, std::size_t observation);
  void startTarget(std::size_t observation, GlobalHypothesis& child);
  TrackTree grow(const PlannedTree& plan);
  void startTarget(const PlannedLeaf& leaf, TrackTree& tree) const;
  void continueTarget(Target& target, std::size_t observation, double seen) const;
  void noteUse(std::size_t observation, std::uint64_t number);
  void linkSharers(HypothesisCluster& cluster);

  HypothesisCluster& old_;
  const ExpansionContext& context_;
  std::uint64_t& next_node_;
  std::size_t& room_;
  AssociationCounts& counts_;
  alignas(std::max_align_t) std::array<std::byte, kFirstMemory> buffer_;
  std::pmr::monotonic_buffer_resource memory_{buffer_.data(), buffer_.size()};  ///< of the leaves
  std::vector<PlannedTree> trees_;  ///< the old ones, then those that start now
  std::vector<GlobalHypothesis> hypotheses_;
  std::map<std::size_t, std::size_t> tree_of_birth_;  ///< by observation
  std::set<std::size_t> refused_;                     ///< observations that found no room
  /// Objects, and the numbers of the targets that may have been seen as them.
  std::vector<std::pair<std::size_t, std::uint64_t>> uses_;
};

}  // namespace datmo
