// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "datmo_fusion/common/class_belief.h"
#include "datmo_fusion/common/options.h"

namespace datmo {

/// Share of moving objects per reported class, if half of all detections were moving.
struct MotionByClassOptions {
  double other = 0.2;        ///< 1
  double pedestrian = 0.86;  ///< 1
  double cyclist = 0.88;     ///< 1
  double vehicle = 0.5;      ///< 1
  double pole = 0.05;        ///< 1

  void visit(OptionVisitor& visitor);
};

/// Returns the log-likelihood ratio of the believed class for a moving versus a standing object:
/// people mostly walk, a car is as often parked, a pole stands. 0 if nothing is known.
double classLogRatio(const ClassProbabilities& belief, const MotionByClassOptions& options);

}  // namespace datmo
