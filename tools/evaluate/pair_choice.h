// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

namespace datmo::evaluation {

/// A row and a column that may be assigned to each other, and the gain of doing so.
struct PairGain {
  std::size_t row = 0;
  std::size_t column = 0;
  double gain = 0.0;  ///< greater than 0, finite
};

/// Chooses pairs such that no row and no column is in two of them and the sum of the gains is
/// greatest; returns their indices in ascending order. No pair of row and column may occur twice.
/// Memory grows with the greatest row and column; pairs that share no row or column with others
/// need no search.
std::vector<std::size_t> choosePairs(const std::vector<PairGain>& pairs);

}  // namespace datmo::evaluation
