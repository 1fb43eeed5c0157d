// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>

#include "datmo_fusion/common/scan.h"
#include "datmo_fusion/grid/grid_window_options.h"
#include "datmo_fusion/ros/stage/input_error.h"

namespace datmo {

/// Checks with the first scans whether the map's window fits the scanner's range: settings of
/// another sensor would work badly without any message. Reported once.
class ScanExtent {
 public:
  explicit ScanExtent(const GridWindowOptions& window) : window_(window) {}

  /// Processes the next scan. `small_window` if many end points lie outside the window for any
  /// heading of the vehicle; `large_window` if the scanner's range is a small part of it.
  std::optional<InputError> update(const Scan& scan);

 private:
  std::optional<InputError> judge(double reach) const;

  GridWindowOptions window_;
  std::size_t scans_ = 0;
  std::size_t hits_ = 0;
  std::size_t outside_ = 0;
  double farthest_ = 0.0;  ///< m, of the hits
};

}  // namespace datmo
