// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "datmo_fusion/tracking/transition_model.h"

namespace datmo::samples {

/// Mean time in a mode, s.
inline double sojourn(const JumpCounts& counts, int mode) {
  return counts.exposure[mode] / counts.jumps.row(mode).sum();
}

}  // namespace datmo::samples
