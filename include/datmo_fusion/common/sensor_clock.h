// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>

#include "datmo_fusion/common/stamp.h"

namespace datmo {

/// Detects that a sensor's clock was set while the sensor was running, and by how much.
///
/// A message is stamped by the sensor's clock at measurement time, and arrives, by another clock,
/// after a delay that is never negative, so the minimum delay over several messages hardly changes
/// (Moon, Skelly, Towsley, Estimation and removal of clock skew from network delay measurements,
/// 1999). A clock that is set leaves two traces of the same size: stamps step away from the
/// sensor's period, and the minimum delay moves the opposite way. A network that becomes slower or
/// faster changes only the delay, a lost message only the stamps, and a pause of the sensor shifts
/// stamps and arrivals together.
///
/// If a message arrives one period after one that was on time, a step is certain at once, otherwise
/// after the delays of the next kRemembered messages.
///
/// Which of the two clocks is wrong is certain if messages arrive before the stamps of only one of
/// them. Otherwise it may be either: a smaller delay is no proof, because a scan that is stamped
/// with its first beam arrives one revolution later. Then the old clock is trusted for kMaxDoubt,
/// and after that the new one: a monitored clock that is wrong has been set back by then.
///
/// Nothing is detected for a sensor without a regular period. Steps of kMaxStep and more are left
/// to StampGate: a single message that far off carries no information, and if the next ones are
/// as well, the comparison starts over. An offset that was there from the start is not detected,
/// unless messages arrive before their stamps. Not thread-safe.
class SensorClock {
 public:
  /// s; smaller steps cannot be told from the jitter of drivers and networks, and amount to a cell
  /// or two of the map at 15 m/s.
  static constexpr double kMinStep = 0.03;
  static constexpr double kMaxStep = 1.0;

  /// s; as often as a synchronized clock is checked (minpoll of chrony and ntpd: 2^6 s).
  static constexpr double kMaxDoubt = 64.0;

  /// Messages from which the period and the minimum delay are taken: two seconds of a scanner, less
  /// of odometry.
  static constexpr std::size_t kRemembered = 20;

  /// Adds the next message, in the order of arrival. Returns how far (s) its stamp is ahead of the
  /// clock that is trusted; negative: behind.
  double add(Stamp stamp, Stamp arrival);

  /// Returns the same for the newest message; 0 if nothing is wrong.
  double ahead() const { return ahead_; }

  /// Returns the least time (s) by which the last kRemembered messages arrived before their stamps:
  /// the clock is ahead, or that of the arrivals is behind. 0 if not all of them did, and from
  /// kMaxStep on, where the two clocks are unrelated.
  double lead() const;

  /// Returns how often the clock was set, including back to its former time.
  std::uint64_t steps() const { return steps_; }

  /// Returns how often a clock that was set became the trusted one.
  std::uint64_t taken() const { return taken_; }

 private:
  struct Message {
    Stamp stamp;
    Stamp arrival;
    double delay() const { return secondsBetween(stamp, arrival); }  ///< s, by the clock's own time
  };

  /// Whether stamps and arrivals both started over: a looped bag.
  bool beginsAgain(const Message& message) const;

  /// Whether a message that is off by kMaxStep or more is confirmed by a second one that is off by
  /// about as much; late ones, which may have waited in a queue, only after kMaxDoubt.
  bool goesOnFromJump(const Message& message);

  void follow(const Message& message);

  /// The sensor's period, s; none unless the last messages kept to it, and most earlier ones to
  /// theirs.
  std::optional<double> period();

  /// Whether a message arrived one period (s) after the last one, which was on time by a clock that
  /// runs at the same rate.
  bool arrivedOnTime(const Message& message, double period) const;

  /// Decides whether the time between two messages is the sensor's, or a step of its clock.
  void judge(const Message& message);
  /// Sets the clock if this message, one period after the previous one, confirms that the previous
  /// one was the first of a clock that was set back.
  void confirm(const Message& message, const std::optional<double>& period);
  /// Decides by the minimum of the last delays what the clock is.
  void decide();
  /// Whether the clock that was set is the right one, as far as can be determined.
  bool isRight() const;
  void set(double ahead);
  void acceptStep();
  void restart(const Message& message);

  std::optional<Message> last_;
  std::optional<Message> jumped_;   ///< the first since `last_` that is off by kMaxStep or more
  std::deque<double> intervals_;    ///< s, between the last stamps
  std::deque<double> recent_;       ///< s, the last delays, by the trusted clock
  std::deque<double> delays_;       ///< s, since the last possible step of the clock
  double min_delay_ = 0.0;          ///< s, of the trusted clock, allowing for clock drift since
  double ahead_ = 0.0;              ///< s
  Stamp set_;                       ///< the arrival before the last step
  std::optional<double> other_;     ///< s, the other candidate for ahead_, until that is decided
  std::optional<double> set_back_;  ///< s, ahead_ if the last message is not a repeated one
  std::uint64_t steps_ = 0;
  std::uint64_t taken_ = 0;
  std::uint64_t judged_ = 0;  ///< intervals, and for how many of them there was a period
  std::uint64_t regular_ = 0;
  std::size_t early_ = 0;  ///< consecutive messages that arrived before their stamps
  double lead_ = 0.0;      ///< s, the smallest of these leads
};

}  // namespace datmo
