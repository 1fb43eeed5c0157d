// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>

#include "datmo_fusion/common/scan.h"
#include "datmo_fusion/ros/stage/stage_monitor.h"

namespace datmo {

/// Scans that wait for the fused grid of their stamp. What is left over is dropped through the
/// monitor.
class WaitingScans {
 public:
  /// `monitor` must outlive it.
  explicit WaitingScans(StageMonitor& monitor) : monitor_(monitor) {}

  /// By rising stamp; a bounded number waits (`no_fused_grid`).
  void add(const Scan& scan);

  /// The scan of this stamp; those before it are dropped (`scan_without_grid`). Without one, a scan
  /// that has no rays, and the monitor is warned (`no_scan_for_grid`).
  Scan take(Stamp stamp);

  void clear() { scans_.clear(); }

 private:
  StageMonitor& monitor_;
  std::deque<Scan> scans_;
  Scan last_field_;  ///< of the last scan: mount and field, without rays
};

}  // namespace datmo
