// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "datmo_fusion/common/stamp.h"

namespace datmo {

/// What to do with a message, by its stamp alone.
enum class StampVerdict {
  kAccept,    ///< newer than everything before
  kRepeated,  ///< same stamp as the newest: drop
  kOld,       ///< older than the newest, but of the same run: drop
  kStray,     ///< far off, and nothing confirms it yet: drop
  kRestart,   ///< the clock jumped back (a looped bag): forget all state, then accept
  kAhead,     ///< it jumped ahead: what was known is of a time that has no place in the new one
};

/// Holds the newest stamp of a stream and judges each further one, so that time in a stage only
/// goes forward, and one wrong stamp costs its own message alone.
///
/// A stamp that is off by a jump is either wrong, or the clock has jumped, or the sensor was
/// silent. The second and third are confirmed by ROS time, which moved as far, or by the next
/// message, which goes on from that stamp and not from the newest one before it: unless other
/// streams contradict it, which the new stamps are further from than the old ones. Then it is the
/// sensor's own clock that is wrong.
///
/// After a silence time has passed, and state is that much older. After a jump of the clock ahead
/// it has not, and nobody can tell what moved how far in between.
class StampGate {
 public:
  /// `restart_after`: a stamp older than the newest by this much (s, more than 0) is a restart of
  /// the clock, not a late message; one that is as much newer is a jump, too.
  explicit StampGate(double restart_after = 1.0) : restart_after_(restart_after) {}

  /// `now`: ROS time at which the message came; without it each jump is followed at once.
  /// `others`: the last stamp of the other streams that came lately, also a stray one; none:
  /// there are no others.
  StampVerdict judge(Stamp stamp, const std::optional<Stamp>& now = std::nullopt,
                     const std::optional<Stamp>& others = std::nullopt);

  /// The newest accepted stamp; none before the first.
  const std::optional<Stamp>& newest() const { return newest_; }

 private:
  bool isJump(double step) const;
  bool isConfirmed(Stamp stamp, const std::optional<Stamp>& now,
                   const std::optional<Stamp>& others) const;
  bool followsStray(Stamp stamp) const;
  /// Whether a confirmed jump ahead is one of the clock, of the others' too.
  bool isAhead(Stamp stamp, const std::optional<Stamp>& now) const;
  void accept(Stamp stamp, double step, const std::optional<Stamp>& now,
              const std::optional<Stamp>& others);

  double restart_after_;
  std::optional<Stamp> newest_;
  std::optional<Stamp> came_;    ///< ROS time of the newest one
  std::optional<Stamp> beside_;  ///< the last stamp of the others then
  double last_step_ = 0.0;       ///< s, from one message to the next, without jumps and gaps
  std::optional<Stamp> stray_;   ///< the last one that nothing has confirmed
};

}  // namespace datmo
