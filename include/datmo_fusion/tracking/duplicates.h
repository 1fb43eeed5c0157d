// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "datmo_fusion/common/box2.h"
#include "datmo_fusion/common/options.h"
#include "datmo_fusion/tracking/target_set.h"

namespace datmo {

/// Returns whether a box, scaled by `scale`, contains the other's center.
bool reaches(Box2 box, const Box2& other, double scale);

struct DuplicateOptions {
  double reach = 2.0;  ///< 1
  /// 0 to 1000: two targets within reach are parts of one object if their velocities are within
  /// this Mahalanobis distance squared: 5.99 is the 95 % quantile of chi-square with two degrees of
  /// freedom
  double velocity_gate = 5.99;

  void visit(OptionVisitor& visitor);
};

/// Returns the numbers, ascending, of the targets that follow another part of an object that a
/// confirmed target already follows: those at the same position, within the size of their boxes,
/// whose velocity does not differ significantly. Of two confirmed ones, the one confirmed first
/// stays.
///
/// Split hypotheses explain most parts of a confirmed target; this is for parts that were followed
/// before it was confirmed.
std::vector<std::uint64_t> findDuplicates(const std::vector<BestTarget>& targets,
                                          const DuplicateOptions& options);

}  // namespace datmo
