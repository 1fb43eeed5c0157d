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
/// Where the map has seen free space, beams end either on a border that few beams meet, such as a
/// curb, or on an object that has come there: the prior probability of the latter is `share`. A
/// border is met by each beam with the probability `border_detection` (between 0 and 1), an object
/// by `detection` of its beams. So if n adjacent beams end on one surface there, the odds of an
/// object are share / (1 - share) * (detection / border_detection)^n: one beam is rather of a curb,
/// two are of either, three are rather of an object. A beam that misses an object parts it in two.
/// All other end points are of what stands. The scan's points: by rising beam index.
std::vector<double> standingProbabilities(const LabeledScan& scan, double border_detection,
                                          const PassingObjectOptions& options);

}  // namespace datmo
