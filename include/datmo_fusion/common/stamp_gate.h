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
  kRestart,   ///< the clock jumped back (a looped bag): forget all state, then accept
};

/// Holds the newest stamp of a stream and judges each further one, so that time in a stage only
/// goes forward.
class StampGate {
 public:
  /// `restart_after`: a stamp older than the newest by this much (s, more than 0) is a restart of
  /// the clock, not a late message.
  explicit StampGate(double restart_after = 1.0) : restart_after_(restart_after) {}

  StampVerdict judge(Stamp stamp);

  /// The newest accepted stamp; none before the first.
  const std::optional<Stamp>& newest() const { return newest_; }

 private:
  double restart_after_;
  std::optional<Stamp> newest_;
};

}  // namespace datmo
