// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/common/stamp_gate.h"

namespace datmo {

StampVerdict StampGate::judge(Stamp stamp) {
  if (newest_ && stamp <= *newest_) {
    if (stamp == *newest_) {
      return StampVerdict::kRepeated;
    }
    if (secondsBetween(stamp, *newest_) < restart_after_) {
      return StampVerdict::kOld;
    }
    newest_ = stamp;
    return StampVerdict::kRestart;
  }
  newest_ = stamp;
  return StampVerdict::kAccept;
}

}  // namespace datmo
