#pragma once

#include <cstddef>
#include <vector>

#include "datmo_fusion/tracking/target.h"

namespace datmo_fusion {

/// Removes targets that follow another part of an object that a confirmed one follows already:
/// those whose centre is inside its box, and whose velocity does not differ significantly
/// (Mahalanobis distance squared up to `velocity_gate`). Of two confirmed ones the older id stays.
/// Returns how many were removed.
///
/// Split and merge hypotheses (thesis figure 4.11) will take its place in a later issue.
std::size_t removeDuplicates(std::vector<Target>& targets, double velocity_gate);

}  // namespace datmo_fusion
