// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <functional>

#include "datmo_fusion/common/stamp.h"
#include "datmo_fusion/slam/odometry_buffer.h"

namespace datmo {

/// Scans that wait for the last odometry before their stamp, where the network may deliver them
/// before it: then the same messages lead to the same poses, whatever the delay of each. The newest
/// sample is that one if the next is due only after the scan (OdometryBuffer::period).
///
/// A scan waits `max_wait` (s) at most by the caller's clock, and not at all where it is 0, or for
/// odometry that is silent: the newest is older than the scan by more than `hold` (s). A bounded
/// number waits. Scans are served in the order in which they came.
class OdometryWait {
 public:
  /// `odometry`: that has come; it must outlive the wait.
  OdometryWait(const OdometryBuffer& odometry, double max_wait, double hold)
      : odometry_(odometry), max_wait_(max_wait), hold_(hold) {}

  double maxWait() const { return max_wait_; }

  /// A scan; `serve` is called when it is its turn. `now`: the caller's clock.
  void add(Stamp scan, Stamp now, std::function<void()> serve);

  /// Serves the oldest scan if it need not wait any longer; false if it does, or there is none.
  bool serveNext(Stamp now);

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
