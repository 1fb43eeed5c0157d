// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "datmo_fusion/tracking/hypothesis_cluster.h"
#include "datmo_fusion/tracking/target_set.h"

namespace datmo {

struct HypothesisOptions {
  int max_hypotheses = 10;
  int scan_history = 3;
  int max_leaves = 8;
  double min_ratio = 1e-3;  ///< 1
  int max_joint_targets = 30;

  void visit(OptionVisitor& visitor);
};

/// One interpretation of a cluster's objects: the observations that exist. Each object of the
/// cluster is a source of exactly one of them.
using Interpretation = std::vector<std::size_t>;

/// Input of the expansion in addition to the cluster.
struct ExpansionContext {
  const AssociationScan& scan;
  const TargetOptions& target;
  const HypothesisOptions& options;
  std::uint64_t scan_number;   ///< counted from the first one
  std::uint64_t first_number;  ///< of the target that the scan's first object may start
  bool best_only;              ///< keep only the most likely hypothesis
  std::int64_t max_work;       ///< per hypothesis, see RankedAssignments
};

/// Returns the cluster after one more scan: of all continuations of its hypotheses, by each
/// interpretation, the `max_hypotheses` most likely ones (Murty's ranking of each hypothesis's
/// assignments, taken best first from all of them: Cox and Hingorani 1996), pruned by
/// `scan_history` (pruneHistory). There must be at least one interpretation, the first with the
/// single objects. The leaves must have their scores.
///
/// `room`: number of new targets that may be started. It and the counts are updated.
HypothesisCluster expand(HypothesisCluster cluster,
                         const std::vector<Interpretation>& interpretations,
                         const ExpansionContext& context, std::uint64_t& next_node,
                         std::size_t& room, AssociationCounts& counts);

}  // namespace datmo
