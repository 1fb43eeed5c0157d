// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <functional>

#include "datmo_fusion/common/stamp.h"
#include "datmo_fusion/slam/odometry_buffer.h"

namespace datmo {

/// Holds scans until the last odometry before their stamp has been received, since the network may
/// deliver them out of order: then the same messages lead to the same poses, whatever the latency
/// of each. The newest sample is the last one if the next is due only after the scan
/// (OdometryBuffer::period).
///
/// A scan waits at most `max_wait` (s) on the caller's clock, and not at all if that is 0 or
/// odometry is silent: the newest is older than the scan by more than `hold` (s). The number of
/// waiting scans is bounded. Scans are served in order of arrival.
class OdometryWait {
 public:
  /// `odometry`: received samples; it must outlive the wait.
  OdometryWait(const OdometryBuffer& odometry, double max_wait, double hold)
      : odometry_(odometry), max_wait_(max_wait), hold_(hold) {}

  double maxWait() const { return max_wait_; }

  /// Adds a scan; `serve` is called when it is its turn. `now`: the caller's clock.
  void add(Stamp scan, Stamp now, std::function<void()> serve);

  /// Serves the oldest scan if it need not wait any longer; returns false if it must, or there is
  /// none.
  bool serveNext(Stamp now);

  /// Drops all scans that wait: the clock has jumped, and they are of the time before.
  void clear() { waiting_.clear(); }

 private:
  struct Waiting {
    Stamp scan;
    Stamp since;  ///< on the caller's clock
    std::function<void()> serve;
  };

  bool mayGoOn(const Waiting& waiting, Stamp now) const;

  const OdometryBuffer& odometry_;
  double max_wait_;
  double hold_;
  std::deque<Waiting> waiting_;
};

}  // namespace datmo
