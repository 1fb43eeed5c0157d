// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

namespace datmo::evaluation {

/// A row and a column that may be given to each other, and what that is worth.
struct PairGain {
  std::size_t row = 0;
  std::size_t column = 0;
  double gain = 0.0;  ///< more than 0, finite
};

/// Chooses pairs such that no row and no column is in two of them and the sum of the gains is
/// greatest; returns their indices, rising. No row and column may be given twice. Memory grows with
/// the greatest row and column; pairs that share nothing with others cost no search.
std::vector<std::size_t> choosePairs(const std::vector<PairGain>& pairs);

}  // namespace datmo::evaluation
