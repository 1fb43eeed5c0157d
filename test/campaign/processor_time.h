// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ctime>

namespace datmo::campaign {

/// CPU time of this process so far, all its threads included, s: independent of other load on the
/// machine.
inline double processorSeconds() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

}  // namespace datmo::campaign
