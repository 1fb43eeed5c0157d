// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace datmo {

/// No part, row or position.
inline constexpr int kNoIndex = -1;

/// A subset of all assignments, and the best one of it: those where the rows before `position`, in
/// the parent's order, have the same as in the parent's best, and `row`, at `position`, does not.
struct RankedPart {
  int parent = kNoIndex;
  int position = 0;
  int row = kNoIndex;
  double cost = 0.0;
  int order = 0;  ///< of the rows: the parent's, until the part gets one of its own
};

}  // namespace datmo
