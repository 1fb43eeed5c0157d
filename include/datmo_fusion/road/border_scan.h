// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "datmo_fusion/common/scan.h"
#include "datmo_fusion/grid/hit_grid.h"

namespace datmo {

/// A scan in the map frame, prepared for border detection.
struct BorderScan {
  /// One beam.
  struct Beam {
    Point2 end = Point2::Zero();  ///< m; for a beam without return, the end of the known free space
    bool hit = false;
    int hits_there = 0;    ///< smoothed count (thesis eq. 3.5.1) of its end point
    bool lasting = false;  ///< its end point has been occupied for longer than a mover stays
  };

  Pose2 scanner;
  double seconds = 0.0;  ///< since the last scan
  double novelty = 1.0;  ///< 0 to 1, share of new information (ScanNovelty)
  std::vector<Beam> beams;
};

/// Converts a scan that `hits` has counted: all beams except blind ones.
BorderScan borderScan(const LabeledScan& scan, const HitGrid& hits, double seconds);

}  // namespace datmo
