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
  double probability;    ///< 0 to 1, of all hypotheses that have this target
};

/// What had to be given up to keep a step short; since construction or clear().
struct AssociationCounts {
  std::uint64_t refused_births = 0;  ///< new objects that found no room
  std::uint64_t cut_hypotheses = 0;  ///< likely enough, but beyond the bounds
  std::uint64_t best_only_steps =
      0;  ///< that ran out of time, and kept the single most likely hypothesis
};

/// The targets that are followed, and the decision which object of each scan is of which of them.
class TargetSet {
 public:
  virtual ~TargetSet() = default;

  /// The same targets once more, to go on by themselves.
  virtual std::unique_ptr<TargetSet> clone() const = 0;

  /// To the time of the next scan, `seconds` >= 0 ahead, and how well its objects fit each target:
  /// both at once, as more targets are followed than the cache holds.
  virtual void predict(double seconds, const AssociationScan& scan) = 0;

  /// Takes in that scan: targets are updated or missed, and objects of no target start new ones.
  virtual void associate(AssociationScan& scan, const StepBudget& budget) = 0;

  /// Targets of the most likely hypothesis, by rising number; valid until the set changes.
  virtual const std::vector<BestTarget>& best() const = 0;

  /// All targets so far have a lower number.
  virtual std::uint64_t nextNumber() const = 0;

  /// Applies a change to all hypotheses of the target with this number.
  virtual void change(std::uint64_t number, const std::function<void(Target&)>& change) = 0;

  /// Removes targets in all hypotheses in which this is true of them.
  virtual void removeIf(const std::function<bool(const Target&)>& isLost) = 0;

  virtual const AssociationCounts& counts() const = 0;

  /// Forgets all targets and counts; numbers go on.
  virtual void clear() = 0;
};

}  // namespace datmo
