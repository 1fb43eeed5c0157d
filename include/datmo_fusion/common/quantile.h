// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace datmo {

/// Returns the smallest value that at least `share` (0 to 1) of the values do not exceed (nearest
/// rank); 0 if there are no values.
inline double quantile(std::vector<double> values, double share) {
  if (values.empty()) {
    return 0.0;
  }
  const double rank = std::ceil(share * static_cast<double>(values.size()));
  const auto index = std::min(static_cast<std::size_t>(std::max(1.0, rank)), values.size()) - 1;
  const auto nth = values.begin() + static_cast<std::ptrdiff_t>(index);
  std::nth_element(values.begin(), nth, values.end());
  return *nth;
}

}  // namespace datmo
