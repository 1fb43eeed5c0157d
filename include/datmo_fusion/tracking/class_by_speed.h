// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "datmo_fusion/common/class_belief.h"
#include "datmo_fusion/common/options.h"

namespace datmo {

struct ClassBySpeedOptions {
  double pedestrian_speed = 2.5;  ///< m/s
  double cyclist_speed = 10.0;    ///< m/s
  double spread = 1.0;            ///< m/s

  void visit(OptionVisitor& visitor);
};

/// What a moving object is, by the sensors' classes and by its speed: seen from behind, a cyclist
/// is as wide and as high as somebody who walks. What looks like a person and is too fast to walk
/// rides, and what is too fast to ride has a motor.
///
/// `speed`: m/s, at least 0, that it surely has. The result sums to 1 if `said` does.
ClassProbabilities weighedBySpeed(const ClassProbabilities& said, double speed,
                                  const ClassBySpeedOptions& options);

}  // namespace datmo
