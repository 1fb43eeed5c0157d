// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/visibility/scan_history.h"

namespace datmo {

struct FreeSpaceEntryTestOptions {
  double seen_when_there = 0.8;  ///< 1
  double seen_when_gone = 0.03;  ///< 1
  double seen_of_ghost = 0.3;    ///< 1
  double max_presence = 2.0;     ///< s
  int max_points = 10;           ///< 1

  void visit(OptionVisitor& visitor);
};

/// Evidence that what is seen at a point has entered free space, and was not there before: the
/// logarithm of the odds of "something entered, and the point was free before" over "the point
/// itself reflects now and then" (a curb, a hedge, paint), by what scans saw of it before. When it
/// came is the likeliest time (a generalized likelihood ratio: Page 1954; Basseville and Nikiforov,
/// Detection of abrupt changes, 1993); what was seen since then counts only to find it.
class FreeSpaceEntryTest {
 public:
  explicit FreeSpaceEntryTest(const FreeSpaceEntryTestOptions& options);

  /// `positions`: where beams of the newest scan ended on the thing, in their order; one
  /// at least. Of many some are taken, spread evenly.
  double evidence(const ScanHistory& history, const std::vector<ReflectionPoint>& positions) const;

 private:
  double evidenceAt(const ScanHistory& history, const ReflectionPoint& position) const;

  FreeSpaceEntryTestOptions options_;
};

}  // namespace datmo
