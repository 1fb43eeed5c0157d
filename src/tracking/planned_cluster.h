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

/// For new targets.
inline constexpr std::size_t kNoTree = std::numeric_limits<std::size_t>::max();

/// A leaf of the next scan before its target is built: many leaves that hypotheses need do not
/// survive pruning, and updating a target is costly.
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

/// The cluster of the next scan while its hypotheses are added. All inputs must outlive it.
class PlannedCluster {
 public:
  /// `cluster`: the old one, whose targets finish() takes over. `room`, `counts`: see expand().
  PlannedCluster(HypothesisCluster& cluster, const ExpansionContext& context,
                 std::uint64_t& next_node, std::size_t& room, AssociationCounts& counts);

  /// Adds the current assignment of a source, unless it needs more leaves than allowed.
  void add(const RankedHypothesis& source);

  std::size_t size() const { return hypotheses_.size(); }

  /// Returns the log weight of the best hypothesis; there must be one.
  double bestWeight() const { return hypotheses_.front().log_weight; }

  /// Prunes, and builds the targets of the remaining leaves from the old ones; call this last.
  HypothesisCluster finish();

 private:
  /// Memory for the leaves of most clusters, bytes; larger ones allocate more.
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
  std::vector<PlannedTree> trees_;  ///< the old ones, then new ones
  std::vector<GlobalHypothesis> hypotheses_;
  std::map<std::size_t, std::size_t> tree_of_birth_;  ///< by observation
  std::set<std::size_t> refused_;                     ///< observations for which there was no room
  /// Objects, and the numbers of the targets that may be associated with them.
  std::vector<std::pair<std::size_t, std::uint64_t>> uses_;
};

}  // namespace datmo
