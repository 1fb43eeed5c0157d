// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "datmo_fusion/common/class_belief.h"
#include "datmo_fusion/common/options.h"

namespace datmo {

/// Of what its detector calls so, the share that moves, were half of all that is detected moving.
struct MotionByClassOptions {
  double other = 0.2;        ///< 1
  double pedestrian = 0.86;  ///< 1
  double cyclist = 0.88;     ///< 1
  double vehicle = 0.5;      ///< 1
  double pole = 0.05;        ///< 1

  void visit(OptionVisitor& visitor);
};

/// Logarithm of how much likelier what is believed of its class is of something that moves than of
/// something that stands: who looks like a person mostly walks, a car is as often parked, a pole
/// stands. 0 while nothing is known.
double classLogRatio(const ClassProbabilities& belief, const MotionByClassOptions& options);

}  // namespace datmo
