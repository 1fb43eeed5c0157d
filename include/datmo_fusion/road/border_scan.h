// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "datmo_fusion/common/scan.h"
#include "datmo_fusion/grid/hit_grid.h"

namespace datmo {

/// A scan as borders are looked for in it: in the map frame.
struct BorderScan {
  /// One beam of it.
  struct Beam {
    Point2 end = Point2::Zero();  ///< m; of a beam without return as far as it is known free
    bool hit = false;
    int hits_there = 0;    ///< smoothed (thesis eq. 3.5.1), of its end point
    bool lasting = false;  ///< what it ends on has been there for longer than a mover stays
  };

  Pose2 scanner;
  double seconds = 0.0;  ///< since the last scan
  double novelty = 1.0;  ///< 0 to 1, of what it sees (ScanNovelty)
  std::vector<Beam> beams;
};

/// Of a scan that `hits` has counted: all beams but those that are blind.
BorderScan borderScan(const LabeledScan& scan, const HitGrid& hits, double seconds);

}  // namespace datmo
