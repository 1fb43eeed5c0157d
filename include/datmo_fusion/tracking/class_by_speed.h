// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "datmo_fusion/common/class_belief.h"
#include "datmo_fusion/common/options.h"
#include "datmo_fusion/tracking/kalman_filter.h"

namespace datmo {

/// Normal distribution of the speed of moving road users of one class.
struct ClassSpeed {
  double mean;  ///< m/s
  double std;   ///< m/s

  /// Returns the standard deviation of each component of a velocity of unknown direction, m/s: few
  /// are faster than twice this.
  double componentStd() const { return 0.5 * mean + std; }
};

struct ClassBySpeedOptions {
  ClassSpeed pedestrian{1.4, 0.6};
  ClassSpeed cyclist{4.8, 1.5};
  ClassSpeed vehicle{7.0, 6.0};

  void visit(OptionVisitor& visitor);
};

/// The speed of an object.
struct MeasuredSpeed {
  double value = 0.0;  ///< m/s, at least 0
  double std = 0.0;    ///< m/s, at least 0
};

/// Returns the speed of a filter's estimate.
MeasuredSpeed speedOf(const StateEstimate& estimate);

/// Returns the class probabilities of a moving object given the sensors' classes and its speed
/// (Bayes); they sum to 1. From behind, a cyclist is as wide and high as a pedestrian, and two
/// beams on a distant car carry no class information. For all other classes, the speed has the mean
/// likelihood of the three.
ClassProbabilities withSpeed(const ClassProbabilities& said, const MeasuredSpeed& speed,
                             const ClassBySpeedOptions& options);

/// Returns the probabilities before the speed was included: the inverse of withSpeed.
ClassProbabilities withoutSpeed(const ClassProbabilities& weighted, const MeasuredSpeed& speed,
                                const ClassBySpeedOptions& options);

}  // namespace datmo
