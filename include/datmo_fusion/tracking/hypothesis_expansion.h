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

/// One interpretation of the objects of a cluster: which observations there are. Each object of the
/// cluster is a source of exactly one of them.
using Interpretation = std::vector<std::size_t>;

/// What growing needs to know beside the cluster.
struct ExpansionContext {
  const AssociationScan& scan;
  const TargetOptions& target;
  const HypothesisOptions& options;
  std::uint64_t scan_number;   ///< counted from the first one
  std::uint64_t first_number;  ///< of the target that the scan's first object may start
  bool best_only;              ///< only the most likely hypothesis
  std::int64_t max_work;       ///< for each hypothesis, see RankedAssignments
};

/// The cluster after one more scan: of all continuations of its hypotheses, by each
/// interpretation, the likeliest `max_hypotheses` (Murty's ranking of each hypothesis's
/// assignments, taken from all of them best first: Cox and Hingorani 1996), pruned by
/// `scan_history` (pruneHistory). Interpretations: at least one, the first with the objects by
/// themselves. Leaves must have their scores.
///
/// `room`: new targets that may be started. Both it and the counts are brought up to date.
HypothesisCluster expand(HypothesisCluster cluster,
                         const std::vector<Interpretation>& interpretations,
                         const ExpansionContext& context, std::uint64_t& next_node,
                         std::size_t& room, AssociationCounts& counts);

}  // namespace datmo
