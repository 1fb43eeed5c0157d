// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "datmo_fusion/tracking/imm_step_cache.h"
#include "datmo_fusion/tracking/target_set.h"

namespace datmo {

/// Global nearest neighbor: the one most likely association of each scan by itself, the sum of
/// scores over all pairs being optimal. What multiple hypotheses are with a single one, and no scan
/// history.
class NearestNeighborTargets : public TargetSet {
 public:
  NearestNeighborTargets(const TargetOptions& target, const AssociationOptions& association);

  void predict(double seconds) override;
  void associate(AssociationScan& scan, const StepBudget& budget) override;
  const std::vector<BestTarget>& best() const override;
  void change(std::uint64_t number, const std::function<void(Target&)>& change) override;
  void removeIf(const std::function<bool(const Target&)>& isLost) override;
  const AssociationCounts& counts() const override { return counts_; }
  void clear() override {
    targets_.clear();
    best_.clear();
    counts_ = {};
  }

 private:
  /// The object of each target, or kUnassigned. Targets that share no object, be it over others,
  /// are assigned by themselves: the cost of an assignment grows with more than its square.
  std::vector<int> assign(const std::vector<TargetScores>& scores, std::size_t objects);

  /// Of the objects that belong to no target.
  void startTargets(const AssociationScan& scan, const std::vector<bool>& explained);

  TargetOptions target_options_;
  ImmStepCache steps_;
  AssociationOptions options_;
  std::vector<std::unique_ptr<Target>> targets_;  ///< by rising number; too large to be moved
  mutable std::vector<BestTarget> best_;
  std::vector<TargetScores> scores_;  ///< of the last scan: memory for the next one
  std::uint64_t next_number_ = 1;
  AssociationCounts counts_;
};

}  // namespace datmo
