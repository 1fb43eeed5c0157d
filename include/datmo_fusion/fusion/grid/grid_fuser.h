// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <vector>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/fusion/grid/grid_fusion.h"
#include "datmo_fusion/fusion/grid/grid_matcher.h"
#include "datmo_fusion/fusion/sync/relative_motion.h"

namespace datmo {

struct GridFuserOptions {
  FusionRule rule = FusionRule::kDempsterShafer;
  double mover_speed = 15.0;                         ///< m/s
  std::map<std::string, GridSourceOptions> sources;  ///< by name; at first lidar, stereo, mono

  /// Vision has priority where it sees, since a planar scanner takes road paint for obstacles and
  /// misses thin poles (thesis 3.2.3). A single camera is used only on request and counts as less
  /// reliable: color is not depth.
  GridFuserOptions();

  void visit(OptionVisitor& visitor);

  /// Names of the sources that are in use.
  std::vector<std::string> sourcesInUse() const;
};

/// Result of fusing one set of matched grids.
struct FusionResult {
  FusedGrids grids;                    ///< at the stamp of the reference's grid
  std::vector<MissingSource> missing;  ///< missing in the set, or with unknown motion
};

/// Transforms matched grids to the reference's stamp and fuses them (thesis 3.2.3). Cells that a
/// mover may have entered between the stamps, at up to `mover_speed`, are not marked free
/// (movedGrid).
class GridFuser {
 public:
  /// Throws OptionError.
  explicit GridFuser(const Checked<GridFuserOptions>& options);

  FusionRule rule() const { return options_.rule; }

  /// All of the set's sources must be in the options (else std::out_of_range).
  FusionResult fuse(const MatchedGrids& matched, const MotionBetween& motion) const;

 private:
  GridFuserOptions options_;
};

}  // namespace datmo
