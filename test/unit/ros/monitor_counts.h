// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "datmo_fusion/ros/stage/stage_monitor.h"

namespace datmo::samples {

/// Returns how many messages were dropped for this reason.
inline std::uint64_t drops(const StageMonitor& monitor, const std::string& reason) {
  const auto found = monitor.drops().find(reason);
  return found == monitor.drops().end() ? 0 : found->second;
}

/// Returns how many warnings were issued for this reason.
inline std::uint64_t warnings(const StageMonitor& monitor, const std::string& reason) {
  const auto found = monitor.warnings().find(reason);
  return found == monitor.warnings().end() ? 0 : found->second;
}

}  // namespace datmo::samples
