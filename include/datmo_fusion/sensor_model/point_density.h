// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <vector>

namespace datmo {

/// Returns the number of image pixels per point of a cloud without holes: how much it was thinned.
///
/// @param counts points in each of equal tiles of the image
/// @param tile_area px
/// @return for nearly the fullest of the tiles with points: most may have holes; 1 if there are
/// none
inline double pixelsPerPoint(const std::vector<int>& counts, double tile_area) {
  constexpr double kHolesShare = 0.8;
  std::vector<int> filled;
  std::copy_if(counts.begin(), counts.end(), std::back_inserter(filled),
               [](int count) { return count > 0; });
  if (filled.empty()) {
    return 1.0;
  }
  const auto dense = filled.begin() + static_cast<std::ptrdiff_t>(
                                          kHolesShare * static_cast<double>(filled.size() - 1));
  std::nth_element(filled.begin(), dense, filled.end());
  return tile_area / *dense;
}

}  // namespace datmo
