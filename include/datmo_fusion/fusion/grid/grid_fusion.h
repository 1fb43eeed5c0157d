// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/grid/sensor_grid.h"

namespace datmo {

/// Rule that combines the evidence of several sensors on a cell.
enum class FusionRule {
  kWeightedSum,  ///< weighted mean over the sensors that know the cell (thesis eq. 3.2.5)
  kPriority,     ///< value of the first sensor that sees the cell: vision, then lidar (eq. 3.2.6)
  kMaximum,      ///< the most occupied (eq. 4.1.8)
  kLogOdds,      ///< Bayes, for independent sensors: the log-odds add up
  kDempsterShafer,  ///< evidence theory, Dempster's rule (perspective of thesis 6.2)
};

/// Weights of one source.
struct GridSourceOptions {
  bool use = true;
  int priority = 0;          ///< for kPriority: the highest wins
  double weight = 0.5;       ///< for kWeightedSum
  double reliability = 1.0;  ///< for kLogOdds, kDempsterShafer and the conflict

  void visit(OptionVisitor& visitor);
};

/// One source's grid with its weights.
struct WeightedGrid {
  const SensorGrid* grid = nullptr;
  GridSourceOptions source;
};

/// Result of grid fusion.
struct FusedGrids {
  SensorGrid fused;
  /// Percent of contradictory evidence, independent of the rule: the mass that Dempster's rule
  /// without normalization assigns to the empty set. Unknown where fewer than two sources know the
  /// cell.
  SensorGrid conflict;
};

/// Fuses grids of one window and one stamp, cell by cell. A cell known to a single source keeps its
/// value; a cell unknown to all stays unknown. `grids`: at least one, all in the window of the
/// first (else std::invalid_argument); the result has the first one's stamp.
///
/// Evidence of a source that reports p: mass 2p - 1 for occupied, or 1 - 2p for free, and the rest
/// for either; times its reliability (Shafer, A mathematical theory of evidence, 1976). As a
/// probability, which kLogOdds uses, that is p drawn toward 1/2. kDempsterShafer gives the
/// pignistic probability (Smets & Kennes, The transferable belief model, 1994): uncommitted mass
/// counts half for occupied. Certain sources that contradict each other leave the cell undecided.
FusedGrids fuseGrids(FusionRule rule, const std::vector<WeightedGrid>& grids);

}  // namespace datmo
