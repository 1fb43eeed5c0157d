// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>

#include "datmo_fusion/common/scan.h"
#include "datmo_fusion/grid/grid_window_options.h"
#include "datmo_fusion/ros/stage/input_error.h"

namespace datmo {

/// Whether the map's window fits what the scanner sees, by its first scans: settings of another
/// sensor set work badly, and without a word. Said once.
class ScanExtent {
 public:
  explicit ScanExtent(const GridWindowOptions& window) : window_(window) {}

  /// Takes the next scan. `small_window` if many end points lie outside of the window, wherever the
  /// vehicle heads; `large_window` if the scanner's reach is a small part of it.
  std::optional<InputError> take(const Scan& scan);

 private:
  std::optional<InputError> judge(double reach) const;

  GridWindowOptions window_;
  std::size_t scans_ = 0;
  std::size_t hits_ = 0;
  std::size_t outside_ = 0;
  double farthest_ = 0.0;  ///< m, of the hits
};

}  // namespace datmo
