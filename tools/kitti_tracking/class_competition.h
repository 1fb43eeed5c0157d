// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "datmo_fusion/common/object.h"

namespace datmo::kitti {

/// Detectors of single classes see a cyclist as a pedestrian too. Of several objects of different
/// lists at one position, at most one is correct: the odds of each are divided by one plus the
/// odds of the others (Bayes' rule for classes that exclude each other). At one position are those
/// of which one's box, seen from above, holds the center of the other.
void compete(std::vector<ObjectList>& lists);

}  // namespace datmo::kitti
