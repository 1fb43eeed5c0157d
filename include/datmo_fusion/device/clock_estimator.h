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

/// Converts the time of a device's clock to the computer's: messages carry the former, arrive at
/// the latter, and are never early. Arrival minus device time is the offset of the clocks, which
/// drifts, plus a positive delay; so the offset is a line below all points of the window, namely
/// the one that is closest to all of them (Moon, Skelly, Towsley, Estimation and removal of clock
/// skew from network delay measurements, 1999). That line is the edge of the points' convex hull
/// below their mean time.
///
/// The smallest delay of all cannot be distinguished from the offset: times are later by it.
class ClockEstimator {
 public:
  /// Throws OptionError.
  explicit ClockEstimator(const Checked<ClockOptions>& options) : options_(*options) {}

  /// Adds a message with the device's time (s, since any epoch) and its arrival. Returns when it
  /// was sent. A clock that was set is detected at once by a message that is too early, and after
  /// `confirm` by messages that are all too late.
  Stamp add(double device, Stamp arrival);

  /// Prepares for a clock that may have been set before the next message; the drift is kept.
  void restart();

  /// Returns the computer's time since its epoch minus the device's since its own, s; none before
  /// the first message.
  std::optional<double> offset() const;

  /// s/s; positive: the device's clock is slow.
  double drift() const { return drift_; }

  /// Returns how often a clock was set.
  std::uint64_t steps() const { return steps_; }

 private:
  /// A message, with its time since the first one.
  struct Point {
    double time = 0.0;   ///< s, of the device
    double delay = 0.0;  ///< s, arrival minus device time
  };

  /// Returns the value of the line below all points.
  double lineAt(double time) const { return intercept_ + drift_ * time; }
  void begin(double device, Stamp arrival);
  void step(double device, Stamp arrival);
  /// Keeps only the earliest message of each short interval.
  void keep(const Point& point);
  void fit();
  /// Returns the slope of the hull's edge below the points' mean time.
  double hullSlope() const;

  ClockOptions options_;
  std::optional<Stamp> origin_;  ///< arrival of the first message; none before it
  double device_origin_ = 0.0;   ///< s
  double newest_ = 0.0;          ///< s, of the device, since the first message
  std::deque<Point> points_;     ///< by ascending time
  double intercept_ = 0.0;       ///< s
  double drift_ = 0.0;
  std::optional<double> late_since_;  ///< s, on the computer's clock; none: the last was on time
  std::uint64_t steps_ = 0;
};

}  // namespace datmo
