// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <functional>
#include <optional>

#include "datmo_fusion/common/stamp.h"

namespace datmo {

/// Scans that wait for the last odometry before their stamp, where the network may deliver them
/// before it: then the same messages lead to the same poses, whatever the delay of
/// each. What is known is the last one if the next is due after the scan only, by the time between
/// the newest two.
///
/// A scan waits `max_wait` (s) at most by the caller's clock, and not at all where it is 0, or for
/// odometry that is silent: the newest is older than the scan by more than `hold` (s). A bounded
/// number waits. Scans are served in the order in which they came.
class OdometryWait {
 public:
  OdometryWait(double max_wait, double hold) : max_wait_(max_wait), hold_(hold) {}

  double maxWait() const { return max_wait_; }

  /// Odometry of this stamp is known.
  void note(Stamp odometry);

  /// A scan; `serve` is called when it is its turn. `now`: the caller's clock.
  void add(Stamp scan, Stamp now, std::function<void()> serve);

  /// Serves the oldest scan if it need not wait any longer; false if it does, or there is none.
  bool serveNext(Stamp now);

  /// The odometry starts over.
  void reset();

 private:
  struct Waiting {
    Stamp scan;
    Stamp since;  ///< on the caller's clock
    std::function<void()> serve;
  };

  bool mayGoOn(const Waiting& waiting, Stamp now) const;

  double max_wait_;
  double hold_;
  std::optional<Stamp> newest_;  ///< odometry
  double period_ = 0.0;          ///< s, between the newest two; 0: not known
  std::deque<Waiting> waiting_;
};

}  // namespace datmo
