// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>

#include "datmo_fusion/common/stamp.h"

namespace datmo {

/// Finds out that a sensor's clock was set while it measured on, and by how much.
///
/// A message is stamped with the time of its measurement by that clock, and arrives by another one
/// after a delay that is never negative, so that the smallest delay of several messages hardly
/// changes (Moon, Skelly, Towsley, Estimation and removal of clock skew from network delay
/// measurements, 1999). A clock that is set leaves two traces, of the same size: stamps step away
/// from the sensor's period, and the smallest delay moves the other way. A network that becomes
/// slower or faster leaves the second alone, a lost message the first alone, and a pause of the
/// sensor moves stamps and arrivals together.
///
/// Where the message comes a period after one that was in time, this is certain at once, else with
/// the delays of the next kRemembered messages.
///
/// Which of the two clocks is wrong is certain where messages come before the stamps of one of them
/// and not before the other's. Else it may be either: a smaller delay is no proof, as a scan that
/// is stamped with its first beam comes a turn later. Then the clock of before is taken for the
/// right one for kMaxDoubt, and after that the new one: a wrong clock that is watched is set back
/// by then.
///
/// Nothing is found of a sensor that keeps to no period, and from kMaxStep on a step is left to
/// StampGate: a message that is off by so much tells nothing, and where the next ones are as well,
/// clocks are compared anew. Of an offset that was there from the start nothing is known, unless
/// messages come before their stamps. Not thread safe.
class SensorClock {
 public:
  /// s; smaller steps cannot be told from the jitter of drivers and networks, and are a cell or two
  /// of the map at 15 m/s.
  static constexpr double kMinStep = 0.03;
  static constexpr double kMaxStep = 1.0;

  /// s; a synchronized clock is looked at as often (minpoll of chrony and ntpd: 2^6 s).
  static constexpr double kMaxDoubt = 64.0;

  /// Messages that tell the period, and how small the delay is: two seconds of a scanner, less of
  /// odometry.
  static constexpr std::size_t kRemembered = 20;

  /// The next message, in the order of arrival. Returns by how much (s) its stamp is ahead of the
  /// clock that is taken for the right one; negative: behind.
  double add(Stamp stamp, Stamp arrival);

  /// Of the newest message; 0 where nothing is wrong.
  double ahead() const { return ahead_; }

  /// s; all of the last kRemembered messages came before their stamps by this or more: the clock is
  /// ahead, or that of the arrivals is behind. 0 where they did not, and from kMaxStep on, where
  /// these clocks have nothing to do with each other.
  double lead() const;

  /// How often the clock was set, back to what it was included.
  std::uint64_t steps() const { return steps_; }

  /// How often a clock that was set was then taken for the right one.
  std::uint64_t taken() const { return taken_; }

 private:
  struct Message {
    Stamp stamp;
    Stamp arrival;
    double delay() const { return secondsBetween(stamp, arrival); }  ///< s, by the clock as it is
  };

  /// Whether stamps and arrivals both began again: a looped bag.
  bool beginsAgain(const Message& message) const;

  /// Whether a message that is off by kMaxStep or more is not the only one: the second one of other
  /// stamps, or of those that are late, which may wait in a queue, the first after kMaxDoubt.
  bool goesOnFromJump(const Message& message);

  void follow(const Message& message);

  /// The sensor's, s; none unless the last messages kept to it, and most of those before to theirs.
  std::optional<double> period();

  /// Whether a message came a period (s) after the last one, and that was in time by a clock that
  /// goes at the same rate.
  bool cameInTime(const Message& message, double period) const;

  /// Takes the time between two messages as one of the sensor's, or as a step of its clock.
  void judge(const Message& message);
  /// Whether the message before was the first one of a clock that was set back, as this one, a
  /// period after it, says: then the clock is set.
  void confirm(const Message& message, const std::optional<double>& period);
  /// Decides by the smallest of the last delays what the clock is.
  void decide();
  /// Whether the clock that was set is the right one, as far as can be told.
  bool isRight() const;
  void set(double ahead);
  void takeAsRight();
  void restart(const Message& message);

  std::optional<Message> last_;
  std::optional<Message> jumped_;  ///< the first of those since that are off by kMaxStep or more
  std::deque<double> intervals_;   ///< s, between the last stamps
  std::deque<double> recent_;      ///< s, the last delays, by the right clock
  std::deque<double> delays_;      ///< s, since the last step that may have been one of the clock
  double min_delay_ = 0.0;       ///< s, of the right clock, as far as clocks may have drifted since
  double ahead_ = 0.0;           ///< s
  Stamp set_;                    ///< the arrival before the last step
  std::optional<double> other_;  ///< s, what it may be as well, until that is decided
  std::optional<double> set_back_;  ///< s, what it is if the last message is no repeated one
  std::uint64_t steps_ = 0;
  std::uint64_t taken_ = 0;
  std::uint64_t judged_ = 0;  ///< intervals, and among how many of them there was a period
  std::uint64_t regular_ = 0;
  std::size_t early_ = 0;  ///< messages in a row that came before their stamps
  double lead_ = 0.0;      ///< s, the least of these
};

}  // namespace datmo
