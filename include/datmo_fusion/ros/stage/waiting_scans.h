// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>

#include "datmo_fusion/common/scan.h"
#include "datmo_fusion/ros/stage/stage_monitor.h"

namespace datmo {

/// Scans that wait for the fused grid of their stamp. Unused ones are dropped and reported to the
/// monitor.
class WaitingScans {
 public:
  /// `monitor` must outlive it.
  explicit WaitingScans(StageMonitor& monitor) : monitor_(monitor) {}

  /// Adds a scan; stamps must rise; a bounded number waits (`no_fused_grid`).
  void add(const Scan& scan);

  /// Returns the scan of this stamp; those before it are dropped (`scan_without_grid`). If there is
  /// none, returns a scan without rays, with a warning to the monitor (`no_scan_for_grid`).
  Scan take(Stamp stamp);

  void clear() { scans_.clear(); }

 private:
  StageMonitor& monitor_;
  std::deque<Scan> scans_;
  Scan last_field_;  ///< mount and field of view of the last scan, without rays
};

}  // namespace datmo
