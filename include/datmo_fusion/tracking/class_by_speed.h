// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "datmo_fusion/common/class_belief.h"
#include "datmo_fusion/common/options.h"
#include "datmo_fusion/tracking/kalman_filter.h"

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

/// How fast an object is.
struct MeasuredSpeed {
  double value = 0.0;  ///< m/s, at least 0
  double std = 0.0;    ///< m/s, at least 0
};

/// Of a filter's estimate.
MeasuredSpeed speedOf(const StateEstimate& estimate);

/// What a moving object is, by the sensors' classes and by its speed (Bayes): seen from behind, a
/// cyclist is as wide and as high as somebody who walks, and of a car far away two beams tell
/// nothing. The speed of anything else is as likely as it is on average of the three.
///
/// The result sums to 1.
ClassProbabilities withSpeed(const ClassProbabilities& said, const MeasuredSpeed& speed,
                             const ClassBySpeedOptions& options);

/// What was said before its speed was taken in: the inverse of withSpeed.
ClassProbabilities withoutSpeed(const ClassProbabilities& weighed, const MeasuredSpeed& speed,
                                const ClassBySpeedOptions& options);

}  // namespace datmo
