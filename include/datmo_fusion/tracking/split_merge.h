// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "datmo_fusion/tracking/association.h"
#include "datmo_fusion/tracking/hypothesis_cluster.h"
#include "datmo_fusion/tracking/hypothesis_expansion.h"

namespace datmo {

struct SplitMergeOptions {
  double split_probability = 0.1;   ///< 1
  double merge_probability = 0.05;  ///< 1
  double margin = 0.5;              ///< m
  int max_interpretations = 6;      ///< 1

  void visit(OptionVisitor& visitor);
};

/// Returns the single objects, ascending, that may be parts of a confirmed target or cover it,
/// within its gate or not. The target must have been predicted to the scan's time. `memory`: a list
/// that is no longer needed, whose memory is reused.
std::vector<std::size_t> relatedObjects(const Target& target, const AssociationScan& scan,
                                        const SplitMergeOptions& options,
                                        std::vector<std::size_t> memory = {});

/// Finds interpretations of a cluster's objects other than each by itself (thesis figure 4.11 d,
/// e): several objects inside the box of a confirmed target may be parts of it, and an object that
/// covers two confirmed targets may be both of them.
///
/// Adds such observations to the scan and to the candidates of the targets that they may belong to,
/// and the interpretations with them to `interpretations`, whose first, with the single objects,
/// must exist. A probability of 0 disables that kind.
void addSplitAndMerged(HypothesisCluster& cluster, AssociationScan& scan,
                       const AssociationOptions& association, const SplitMergeOptions& options,
                       std::vector<Interpretation>& interpretations);

}  // namespace datmo
