// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/common/scan.h"

namespace datmo {

struct PassingObjectOptions {
  double share = 0.02;     ///< 1
  double detection = 0.8;  ///< 1

  void visit(OptionVisitor& visitor);
};

/// Of each end point of a scan the probability, 0 to 1, that it is of what stands there, and not of
/// something that passes by.
///
/// Where the map has seen free space, a beam ends either on a border that few beams meet, such as a
/// curb, or on an object that has come there. A border is met by each beam with the probability
/// `border_detection` (0 to 1), an object by `detection` of its beams; `share` of such end points
/// are of objects. So of n adjacent beams that end on one surface there, the odds are
/// share * (detection / border_detection)^n: one beam is of a curb, five are of a car. All other
/// end points are of what stands.
std::vector<double> standingProbabilities(const LabeledScan& scan, double border_detection,
                                          const PassingObjectOptions& options);

}  // namespace datmo
