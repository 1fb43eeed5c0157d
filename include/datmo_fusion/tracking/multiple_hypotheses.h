// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "datmo_fusion/tracking/hypothesis_cluster.h"
#include "datmo_fusion/tracking/hypothesis_expansion.h"
#include "datmo_fusion/tracking/imm_step_cache.h"
#include "datmo_fusion/tracking/split_merge.h"
#include "datmo_fusion/tracking/target_set.h"

namespace datmo {

/// Multiple hypothesis tracking (Reid 1979; Cox and Hingorani 1996; Blackman 2004; thesis 3.3.4):
/// a track tree of possible observations for each target, global hypotheses for each cluster of
/// targets that compete for objects, and pruning of decisions that are a few scans old.
///
/// With one hypothesis, no scan history, and neither split nor merged objects it is equivalent to
/// NearestNeighborTargets.
class MultipleHypotheses : public TargetSet {
 public:
  MultipleHypotheses(const TargetOptions& target, const AssociationOptions& association,
                     const HypothesisOptions& hypotheses, const SplitMergeOptions& split_merge);

  std::unique_ptr<TargetSet> clone() const override;
  void predict(double seconds, const AssociationScan& scan) override;
  void associate(AssociationScan& scan, const StepBudget& budget) override;
  const std::vector<BestTarget>& best() const override;
  std::uint64_t nextNumber() const override { return next_number_; }
  void change(std::uint64_t number, const std::function<void(Target&)>& change) override;
  void removeIf(const std::function<bool(const Target&)>& isLost) override;
  const AssociationCounts& counts() const override { return counts_; }
  void clear() override {
    best_known_ = false;
    clusters_.clear();
    counts_ = {};
  }

 private:
  void mergeCompeting(std::size_t objects);
  void removeEmpty();
  void expandCluster(HypothesisCluster cluster, AssociationScan& scan, const StepBudget& budget,
                     std::vector<HypothesisCluster>& next);
  void missSingle(HypothesisCluster& cluster);
  void startTargets(const AssociationScan& scan, const std::vector<bool>& claimed,
                    std::vector<HypothesisCluster>& next);
  std::size_t targets() const;
  /// Finds the targets of each cluster's best hypothesis, by number. Unused leaves have been
  /// removed (canonicalize), so with only one hypothesis each tree has one leaf.
  void findBest() const;

  TargetOptions target_options_;
  ImmStepCache steps_;
  AssociationOptions options_;
  HypothesisOptions hypothesis_options_;
  SplitMergeOptions split_merge_;
  std::vector<HypothesisCluster> clusters_;
  mutable std::vector<BestTarget> best_;
  mutable bool best_known_ = false;  ///< false: targets have changed
  std::uint64_t scan_number_ = 0;
  std::uint64_t next_number_ = 1;
  std::uint64_t next_node_ = 1;
  std::size_t room_ = 0;  ///< in the current scan, for new targets
  AssociationCounts counts_;
};

}  // namespace datmo
