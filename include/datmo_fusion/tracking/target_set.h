// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "datmo_fusion/tracking/association.h"
#include "datmo_fusion/tracking/step_budget.h"
#include "datmo_fusion/tracking/target.h"

namespace datmo {

/// A target of the most likely hypothesis.
struct BestTarget {
  const Target* target;  ///< valid until the set changes
  double probability;    ///< 0 to 1, summed over all hypotheses with this target
};

/// What was omitted to keep steps short, counted since construction or clear().
struct AssociationCounts {
  std::uint64_t refused_births = 0;   ///< new objects for which there was no room
  std::uint64_t cut_hypotheses = 0;   ///< likely enough, but beyond the limits
  std::uint64_t best_only_steps = 0;  ///< ran out of time and kept only the most likely hypothesis
};

/// All targets, and the association of the objects of each scan with them.
class TargetSet {
 public:
  virtual ~TargetSet() = default;

  /// Returns an independent copy.
  virtual std::unique_ptr<TargetSet> clone() const = 0;

  /// Predicts to the time of the next scan, `seconds` >= 0 ahead, and scores its objects for each
  /// target; in one pass, because more targets are followed than fit in the cache.
  virtual void predict(double seconds, const AssociationScan& scan) = 0;

  /// Associates that scan: targets are updated or missed, and objects of no target start new ones.
  virtual void associate(AssociationScan& scan, const StepBudget& budget) = 0;

  /// Returns the targets of the most likely hypothesis, by ascending number; valid until the set
  /// changes.
  virtual const std::vector<BestTarget>& best() const = 0;

  /// Returns the next number; those of all targets so far are lower.
  virtual std::uint64_t nextNumber() const = 0;

  /// Applies a change to the target with this number in all hypotheses.
  virtual void change(std::uint64_t number, const std::function<void(Target&)>& change) = 0;

  /// Removes targets for which `isLost` is true, in all hypotheses.
  virtual void removeIf(const std::function<bool(const Target&)>& isLost) = 0;

  virtual const AssociationCounts& counts() const = 0;

  /// Removes all targets and counts; numbers continue.
  virtual void clear() = 0;
};

}  // namespace datmo
