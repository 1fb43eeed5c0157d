// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/tracking/motion_likelihood.h"

namespace datmo::evaluation {

/// The observer to which delays are compared; unit, range and source of each option in visit().
struct AttainableOptions {
  double range_noise = 0.2;                                                      ///< m
  double required_probability = MotionLikelihoodOptions().required_probability;  ///< 1
  double moving_prior = MotionLikelihoodOptions().moving_prior;                  ///< 1

  void visit(OptionVisitor& visitor);

  /// Log-likelihood ratio from which on motion is distinguished from rest.
  double requiredLogRatio() const;
};

}  // namespace datmo::evaluation
