// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/stage/waiting_scans.h"

#include <string>
#include <utility>

namespace datmo {

namespace {

/// One second of a fast scanner: longer than grid fusion waits for a slow sensor.
constexpr std::size_t kMaxWaitingScans = 50;

}  // namespace

void WaitingScans::add(const Scan& scan) {
  last_field_ = {scan.stamp, scan.scanner_in_base, scan.field, {}};
  scans_.push_back(scan);
  if (scans_.size() > kMaxWaitingScans) {
    scans_.pop_front();
    monitor_.dropped(InputError("no_fused_grid", "more than " + std::to_string(kMaxWaitingScans) +
                                                     " scans wait for their fused grid: expected "
                                                     "one from grid_fusion, dropped the oldest"));
  }
}

Scan WaitingScans::take(Stamp stamp) {
  while (!scans_.empty() && scans_.front().stamp < stamp) {
    scans_.pop_front();
    monitor_.dropped(
        InputError("scan_without_grid", "a scan without fused grid: expected one with its stamp"));
  }
  if (!scans_.empty() && scans_.front().stamp == stamp) {
    Scan scan = std::move(scans_.front());
    scans_.pop_front();
    return scan;
  }
  monitor_.warned(InputError("no_scan_for_grid",
                             "no scan with the fused grid's stamp: continues with the grid alone"));
  Scan scan = last_field_;
  scan.stamp = stamp;
  return scan;
}

}  // namespace datmo
