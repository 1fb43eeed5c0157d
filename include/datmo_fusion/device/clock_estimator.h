// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/common/stamp.h"

namespace datmo {

struct ClockOptions {
  double window = 60.0;     ///< s
  double settle = 10.0;     ///< s
  double max_drift = 5e-4;  ///< s/s
  double step = 0.2;        ///< s
  double confirm = 0.5;     ///< s

  void visit(OptionVisitor& visitor);
};

/// The time of a device's clock on the computer's: messages carry the one, arrive at the other, and
/// are never early. Arrival minus device time is the clocks' offset, which drifts, plus a delay
/// that is positive; so the offset is a line below all points of the last minute, and of those the
/// one that is nearest to them all (Moon, Skelly, Towsley, Estimation and removal of clock skew
/// from network delay measurements, 1999). That line is the edge of the points' convex hull below
/// their mean time.
///
/// The smallest delay of all cannot be distinguished from the offset: times are later by it.
class ClockEstimator {
 public:
  /// Throws OptionError.
  explicit ClockEstimator(const Checked<ClockOptions>& options) : options_(*options) {}

  /// A message with the device's time (s, since any epoch), and when it arrived. Returns when it
  /// was sent. A clock that was set is found out by a message that is too early at once, by
  /// messages that are all too late after `confirm`.
  Stamp add(double device, Stamp arrival);

  /// The next message may be of a clock that was set; the drift stays.
  void restart();

  /// s, the computer's time since its epoch minus the device's since its own; none before the first
  /// message.
  std::optional<double> offset() const;

  /// s/s; positive: the device's clock is slow.
  double drift() const { return drift_; }

  /// How often a clock was set.
  std::uint64_t steps() const { return steps_; }

 private:
  /// A message in the time since the first one.
  struct Point {
    double time = 0.0;   ///< s, of the device
    double delay = 0.0;  ///< s, arrival minus device time
  };

  /// Of the line below all points.
  double lineAt(double time) const { return intercept_ + drift_ * time; }
  void begin(double device, Stamp arrival);
  void step(double device, Stamp arrival);
  /// Of each short time the earliest message alone counts.
  void keep(const Point& point);
  void fit();
  /// The slope of the hull's edge below the points' mean time.
  double hullSlope() const;

  ClockOptions options_;
  std::optional<Stamp> origin_;  ///< arrival of the first message; none before it
  double device_origin_ = 0.0;   ///< s
  double newest_ = 0.0;          ///< s, of the device, since the first message
  std::deque<Point> points_;     ///< by rising time
  double intercept_ = 0.0;       ///< s
  double drift_ = 0.0;
  std::optional<double> late_since_;  ///< s, on the computer's clock; none: the last was in time
  std::uint64_t steps_ = 0;
};

}  // namespace datmo
