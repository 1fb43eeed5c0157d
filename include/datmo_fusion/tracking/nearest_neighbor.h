// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "datmo_fusion/tracking/imm_step_cache.h"
#include "datmo_fusion/tracking/target_set.h"

namespace datmo {

/// Global nearest neighbor: the most likely association of each scan by itself, with the maximum
/// sum of scores over all pairs. The same as multiple hypotheses with a single one and no scan
/// history.
class NearestNeighborTargets : public TargetSet {
 public:
  NearestNeighborTargets(const TargetOptions& target, const AssociationOptions& association);

  std::unique_ptr<TargetSet> clone() const override;
  void predict(double seconds, const AssociationScan& scan) override;
  void associate(AssociationScan& scan, const StepBudget& budget) override;
  const std::vector<BestTarget>& best() const override;
  std::uint64_t nextNumber() const override { return next_number_; }
  void change(std::uint64_t number, const std::function<void(Target&)>& change) override;
  void removeIf(const std::function<bool(const Target&)>& isLost) override;
  const AssociationCounts& counts() const override { return counts_; }
  void clear() override {
    targets_.clear();
    best_.clear();
    counts_ = {};
  }

 private:
  struct ScoredTarget {
    explicit ScoredTarget(std::unique_ptr<Target> of_target) : target(std::move(of_target)) {}
    ScoredTarget(const ScoredTarget& other)
        : target(std::make_unique<Target>(*other.target)), scores(other.scores) {}
    ScoredTarget(ScoredTarget&&) noexcept = default;
    ScoredTarget& operator=(const ScoredTarget&) = delete;
    ScoredTarget& operator=(ScoredTarget&&) noexcept = default;
    ~ScoredTarget() = default;

    std::unique_ptr<Target> target;  ///< too large to move
    TargetScores scores;             ///< for the current scan
  };

  /// The object of each target, or kUnassigned. Groups of targets that share no object, not even
  /// through others, are solved separately, because the cost grows faster than quadratically.
  std::vector<int> assign(std::size_t objects);

  /// Starts targets from the objects that belong to no target.
  void startTargets(const AssociationScan& scan, const std::vector<bool>& explained);

  TargetOptions target_options_;
  ImmStepCache steps_;
  AssociationOptions options_;
  std::vector<ScoredTarget> targets_;  ///< by ascending number
  mutable std::vector<BestTarget> best_;
  std::uint64_t next_number_ = 1;
  AssociationCounts counts_;
};

}  // namespace datmo
