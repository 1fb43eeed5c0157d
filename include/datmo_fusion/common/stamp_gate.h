// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "datmo_fusion/common/stamp.h"

namespace datmo {

/// What to do with a message, judged by its stamp alone.
enum class StampVerdict {
  kAccept,    ///< newer than all before
  kRepeated,  ///< same stamp as the newest: drop
  kOld,       ///< older than the newest, but on the same clock: drop
  kStray,     ///< far off, and not confirmed yet: drop
  kRestart,   ///< the clock jumped back (a looped bag): reset all state, then accept
  kAhead,     ///< the clock jumped ahead: earlier state cannot be related to the new time
};

/// Keeps the newest stamp of a stream and judges each further one, so that time in a stage only
/// moves forward, and a single wrong stamp costs only its own message.
///
/// If a stamp is off by a jump, either it is wrong, or the clock has jumped, or the sensor was
/// silent. The latter two are confirmed by ROS time, if it moved as far, or by the next message, if
/// it continues from that stamp and not from the newest one before it, unless other streams
/// contradict it: if they are further from the new stamps than from the old ones, the sensor's own
/// clock is wrong.
///
/// After a silence, time has passed, and state is that much older. If the clock jumped ahead, it
/// has not, and nobody can tell how far things moved in between.
class StampGate {
 public:
  /// `restart_after`: a stamp older than the newest by this much (s, more than 0) is a restart of
  /// the clock, not a late message; one that is newer by as much is a jump, too.
  explicit StampGate(double restart_after = 1.0) : restart_after_(restart_after) {}

  /// Judges the next stamp. `now`: ROS time of arrival; without it, each jump is followed at once.
  /// `others`: the last recent stamp of the other streams, even a stray one; none if there are no
  /// others.
  StampVerdict judge(Stamp stamp, const std::optional<Stamp>& now = std::nullopt,
                     const std::optional<Stamp>& others = std::nullopt);

  /// Returns the newest accepted stamp; none before the first.
  const std::optional<Stamp>& newest() const { return newest_; }

 private:
  bool isJump(double step) const;
  bool isConfirmed(Stamp stamp, const std::optional<Stamp>& now,
                   const std::optional<Stamp>& others) const;
  bool followsStray(Stamp stamp) const;
  /// Whether a confirmed jump ahead is one of the clock, including that of the other streams.
  bool isAhead(Stamp stamp, const std::optional<Stamp>& now) const;
  void accept(Stamp stamp, double step, const std::optional<Stamp>& now,
              const std::optional<Stamp>& others);

  double restart_after_;
  std::optional<Stamp> newest_;
  std::optional<Stamp> arrived_;  ///< ROS time of its arrival
  std::optional<Stamp> beside_;   ///< the last stamp of the others at that time
  double last_step_ = 0.0;        ///< s, from one message to the next, without jumps and gaps
  std::optional<Stamp> stray_;    ///< the last unconfirmed one
};

}  // namespace datmo
