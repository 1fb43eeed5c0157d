#pragma once

#include <cstddef>
#include <vector>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/tracking/target.h"

namespace datmo {

struct DuplicateOptions {
  double reach = 2.0;           ///< 1
  double velocity_gate = 13.8;  ///< 1

  void visit(OptionVisitor& visitor);
};

/// Removes targets that follow another part of an object that a confirmed one follows already:
/// those at the same place, within the size of their boxes, whose velocity does not differ
/// significantly. Of two confirmed ones the older id stays. Returns how many were removed.
///
/// Split and merge hypotheses (thesis figure 4.11) will take its place in a later issue.
std::size_t removeDuplicates(std::vector<Target>& targets, const DuplicateOptions& options);

}  // namespace datmo
