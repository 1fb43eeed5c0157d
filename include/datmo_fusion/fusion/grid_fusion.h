#pragma once

#include <string>
#include <vector>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/grid/sensor_grid.h"

namespace datmo {

/// How what several sensors say of a cell becomes one statement.
enum class FusionRule {
  kWeightedSum,     ///< mean of those that know the cell, by weight (thesis eq. 3.2.5)
  kPriority,        ///< the word of the first that sees the cell: vision, then lidar (eq. 3.2.6)
  kMaximum,         ///< the most occupied (eq. 4.1.8)
  kLogOdds,         ///< Bayes, for independent sensors: the log-odds add up
  kDempsterShafer,  ///< evidence theory, Dempster's rule (perspective of thesis 6.2)
};

/// The rules under the names that parameters use: weighted_sum, priority, maximum, log_odds,
/// dempster_shafer.
const std::vector<std::string>& fusionRuleNames();

/// Throws OptionError for a name that there is not.
FusionRule fusionRule(const std::string& name);

/// How far one source is to be believed.
struct GridSourceOptions {
  bool use = true;
  int priority = 0;          ///< for kPriority: the highest has the word
  double weight = 0.5;       ///< for kWeightedSum
  double reliability = 1.0;  ///< for kLogOdds, kDempsterShafer and the conflict

  void visit(OptionVisitor& visitor);
};

/// What one source says, and how far it is to be believed.
struct WeighedGrid {
  const SensorGrid* grid = nullptr;
  GridSourceOptions source;
};

struct FusedGrids {
  SensorGrid fused;
  SensorGrid conflict;  ///< percent of the evidence that contradicts itself; unknown: no two know
};

/// Fuses grids of one window and one time, cell by cell. A cell that one source alone knows is as
/// that one says; one that nobody knows stays unknown. `grids`: at least one, all of the first
/// one's window (else std::invalid_argument); the result has the first one's stamp.
FusedGrids fuseGrids(FusionRule rule, const std::vector<WeighedGrid>& grids);

}  // namespace datmo
