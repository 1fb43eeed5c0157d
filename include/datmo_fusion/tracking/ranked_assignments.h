#pragma once

#include <memory>
#include <optional>

#include "datmo_fusion/tracking/assignment.h"

namespace datmo {

/// All assignments of one problem, the best first (Murty 1968; Miller, Stone, Cox 1997).
class RankedAssignments {
 public:
  /// As solveAssignment(); throws the same.
  RankedAssignments(CostMatrix cost, Eigen::VectorXd unassigned_cost);
  ~RankedAssignments();

  /// The next one by rising cost, each once; none when there are no more. The first is that of
  /// solveAssignment().
  std::optional<Assignment> next();
};

}  // namespace datmo
