// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "datmo_fusion/common/object.h"

namespace datmo::kitti {

/// Single-class detectors report a cyclist as a pedestrian, too. Of several objects of different
/// lists at one position, at most one is correct: the odds of each are divided by one plus the odds
/// of the others (Bayes' rule for mutually exclusive classes). Two objects are at one position if
/// the box of one, seen from above, contains the center of the other.
void compete(std::vector<ObjectList>& lists);

}  // namespace datmo::kitti
