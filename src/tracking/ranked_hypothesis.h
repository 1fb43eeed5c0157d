// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "datmo_fusion/assignment/ranked_assignments.h"
#include "datmo_fusion/tracking/hypothesis_cluster.h"
#include "datmo_fusion/tracking/hypothesis_expansion.h"

namespace datmo {

/// One hypothesis of a cluster with one interpretation of its objects, and its continuations: the
/// assignments of observations to targets, best first, but only those that assign a target to each
/// observation that needs one. All inputs must outlive it.
class RankedHypothesis {
 public:
  RankedHypothesis(const HypothesisCluster& cluster, const AssociationScan& scan,
                   const GlobalHypothesis& parent, const Interpretation& interpretation);

  /// Returns an upper bound for the log weight of all assignments.
  double bound() const;

  /// Finds the best assignment, if there is any, within this work limit (see RankedAssignments);
  /// call this before all functions below.
  void rank(std::int64_t max_work);

  /// Returns whether the work limit was reached, so that the current assignment may not be the
  /// best.
  bool cut() const { return ranked_->cut(); }

  void advance();
  bool isDone() const { return !present_; }

  /// Returns the log weight of the current assignment.
  double weight() const;

  /// Returns the observation of each tree of the cluster in the current assignment; kUnseen: none.
  std::vector<std::size_t> observations() const;

  const GlobalHypothesis& parent() const { return *parent_; }
  const Interpretation& interpretation() const { return *interpretation_; }

 private:
  const TargetScores& scores(std::size_t tree) const;
  bool isComplete() const;

  const HypothesisCluster* cluster_;
  const GlobalHypothesis* parent_;
  const Interpretation* interpretation_;
  double base_;                        ///< log weight if all targets are missed
  std::vector<std::size_t> rows_;      ///< trees that are present
  std::vector<int> required_columns_;  ///< columns that need a target
  std::unique_ptr<RankedAssignments> ranked_;
  std::optional<Assignment> present_;
};

}  // namespace datmo
