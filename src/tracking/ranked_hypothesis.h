// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "datmo_fusion/assignment/ranked_assignments.h"
#include "datmo_fusion/tracking/hypothesis_cluster.h"
#include "datmo_fusion/tracking/hypothesis_expansion.h"

namespace datmo {

/// One hypothesis of a cluster with one interpretation of its objects, and its continuations: its
/// assignments of observations to targets, best first. Only those that give a target to each
/// observation that needs one. All that it is made of must outlive it.
class RankedHypothesis {
 public:
  RankedHypothesis(const HypothesisCluster& cluster, const AssociationScan& scan,
                   const GlobalHypothesis& parent, const Interpretation& interpretation);

  /// No assignment weighs more (logarithm).
  double bound() const;

  /// Finds the best assignment, if there is any; with no more than this work (see
  /// RankedAssignments); to be called before all below.
  void rank(std::int64_t max_work);

  /// The work allowed was not enough, and the present assignment may not be the best.
  bool cut() const { return ranked_->cut(); }

  void advance();
  bool isDone() const { return !present_; }

  /// Of the present assignment, logarithm.
  double weight() const;

  /// Observation of each tree of the cluster in the present assignment; kUnseen: none.
  std::vector<std::size_t> observations() const;

  const GlobalHypothesis& parent() const { return *parent_; }
  const Interpretation& interpretation() const { return *interpretation_; }

 private:
  const TargetScores& scores(std::size_t tree) const;
  bool isComplete() const;

  const HypothesisCluster* cluster_;
  const GlobalHypothesis* parent_;
  const Interpretation* interpretation_;
  double base_;                    ///< logarithm of the weight if all targets are missed
  std::vector<std::size_t> rows_;  ///< trees that are present
  std::vector<int> needy_;         ///< columns that need a target
  std::unique_ptr<RankedAssignments> ranked_;
  std::optional<Assignment> present_;
};

}  // namespace datmo
