#pragma once

#include "datmo_fusion/common/class_belief.h"
#include "datmo_fusion/common/options.h"

namespace datmo {

struct ClassBySpeedOptions {
  double pedestrian_speed = 2.5;  ///< m/s
  double cyclist_speed = 10.0;    ///< m/s
  double spread = 1.0;            ///< m/s
  double least_weight = 0.02;     ///< 1

  void visit(OptionVisitor& visitor);
};

/// What a moving object is, by what sensors say of it and by its speed: seen from behind, a cyclist
/// is as wide and as high as somebody who walks.
///
/// `speed`: m/s, at least 0, that it surely has. The result sums to 1.
ClassProbabilities weighedBySpeed(const ClassProbabilities& said, double speed,
                                  const ClassBySpeedOptions& options);

}  // namespace datmo
