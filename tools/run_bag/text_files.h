// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace datmo {

/// Files for results as text; empty: none.
struct TextFiles {
  std::string tum;    ///< poses of the vehicle
  std::string kitti;  ///< tracks
  std::string mot;    ///< tracks
};

}  // namespace datmo
