// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "datmo_fusion/common/class_belief.h"
#include "datmo_fusion/common/options.h"

namespace datmo {

/// The speeds of road users of one class, while they move: normally distributed.
struct ClassSpeed {
  double mean;  ///< m/s
  double std;   ///< m/s

  /// m/s, standard deviation of each component of a velocity of unknown direction: few are faster
  /// than two of it.
  double componentStd() const { return 0.5 * mean + std; }
};

struct ClassBySpeedOptions {
  ClassSpeed pedestrian{1.4, 0.6};
  ClassSpeed cyclist{4.8, 1.5};
  ClassSpeed vehicle{7.0, 6.0};

  void visit(OptionVisitor& visitor);
};

/// What a moving object is, by the sensors' classes and by its speed (Bayes): seen from behind, a
/// cyclist is as wide and as high as somebody who walks, and of a car far away two beams tell
/// nothing. The speed of anything else is as likely as it is on average of the three.
///
/// `speed`: m/s, at least 0, with its standard deviation (m/s). The result sums to 1.
ClassProbabilities weighedBySpeed(const ClassProbabilities& said, double speed, double speed_std,
                                  const ClassBySpeedOptions& options);

}  // namespace datmo
