#pragma once

#include <vector>

#include "datmo_fusion/common/object.h"

namespace datmo::kitti {

/// Detectors of single classes see a cyclist as a pedestrian too. Of several objects of different
/// lists in one place, at most one is what it says: the odds of each are divided by one plus the
/// odds of the others (Bayes' rule for classes that exclude each other). In one place are those
/// of which one's box, seen from above, holds the center of the other.
void compete(std::vector<ObjectList>& lists);

}  // namespace datmo::kitti
