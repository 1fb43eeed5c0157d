// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/scanner_options.h"

namespace datmo {

void ScannerOptions::visit(OptionVisitor& visitor) {
  scan.visit(visitor);
  visitor.number(
      {"range_sigma", "m",
       "standard deviation of its range, for scan matching, boxes of objects, borders of the road "
       "and the alignment of a stereo camera; within a multiple of it (end_margin) before its end "
       "point a beam frees nothing; 0: unknown: 0.1 for boxes, 0.2 for matching and borders, 0.03 "
       "for the alignment, and free up to the end point",
       Tier::kPublic},
      range_sigma, {0.0, 2.0});
  visitor.number({"end_margin", "1",
                  "within this many standard deviations of the range before its end point a beam "
                  "frees nothing, in maps and in lidar_grid: the surface that it hit may be there. "
                  "If beams free all cells up to the end point (0: thesis), a surface keeps its "
                  "noisy hits behind it and loses those in front of it, so that everything that "
                  "comes into view is mapped too far away, and the pose drifts"},
                 end_margin, {0.0, 10.0});
  visitor.number({"beam_width", "rad",
                  "opening angle of a beam, for lidar_grid; 0: it reaches halfway to its neighbors "
                  "(thesis 3.2.1: each cell uses the nearest beam)",
                  Tier::kPublic},
                 beam_width, {0.0, 0.2});
  visitor.number({"max_tilt", "rad", "a scan plane tilted by more than this causes a warning"},
                 max_tilt, {0.0, kPi / 2.0});
}

}  // namespace datmo
