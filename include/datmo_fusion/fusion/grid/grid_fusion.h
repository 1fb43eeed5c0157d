// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/grid/sensor_grid.h"

namespace datmo {

/// Rule that combines the evidence of several sensors on a cell.
enum class FusionRule {
  kWeightedSum,     ///< mean of those that know the cell, by weight (thesis eq. 3.2.5)
  kPriority,        ///< the value of the first that sees the cell: vision, then lidar (eq. 3.2.6)
  kMaximum,         ///< the most occupied (eq. 4.1.8)
  kLogOdds,         ///< Bayes, for independent sensors: the log-odds add up
  kDempsterShafer,  ///< evidence theory, Dempster's rule (perspective of thesis 6.2)
};

/// How far one source is to be believed.
struct GridSourceOptions {
  bool use = true;
  int priority = 0;          ///< for kPriority: the highest decides
  double weight = 0.5;       ///< for kWeightedSum
  double reliability = 1.0;  ///< for kLogOdds, kDempsterShafer and the conflict

  void visit(OptionVisitor& visitor);
};

/// What one source says, and how far it is to be believed.
struct WeighedGrid {
  const SensorGrid* grid = nullptr;
  GridSourceOptions source;
};

/// What the fusion of grids gives.
struct FusedGrids {
  SensorGrid fused;
  /// Percent of the evidence that contradicts itself, whatever the rule: the mass that Dempster's
  /// rule without its normalization gives to the empty set. Unknown where no two know.
  SensorGrid conflict;
};

/// Fuses grids of one window and one time, cell by cell. A cell that one source alone knows is as
/// that one says; one that nobody knows stays unknown. `grids`: at least one, all of the first
/// one's window (else std::invalid_argument); the result has the first one's stamp.
///
/// Evidence of a source that says p: 2p - 1 for occupied, or 1 - 2p for free, the rest for either
/// of them; times its reliability (Shafer, A mathematical theory of evidence, 1976). As a
/// probability, which kLogOdds takes, that is p drawn toward 1/2. kDempsterShafer gives the
/// pignistic probability (Smets & Kennes, The transferable belief model, 1994): what is open counts
/// half for occupied. Certain sources that contradict each other leave the cell undecided.
FusedGrids fuseGrids(FusionRule rule, const std::vector<WeighedGrid>& grids);

}  // namespace datmo
