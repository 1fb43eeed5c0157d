// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/scanner_options.h"

namespace datmo {

void ScannerOptions::visit(OptionVisitor& visitor) {
  scan.visit(visitor);
  visitor.number({"range_sigma", "m",
                  "standard deviation of its range, for the match of scans, boxes of objects, "
                  "borders of the road and the alignment of a stereo camera; before its end a beam "
                  "frees nothing for some of it (end_margin); 0: not known: 0.1 for boxes, 0.2 for "
                  "the match and borders, 0.03 for the alignment, and free up to the end",
                  Tier::kPublic},
                 range_sigma, {0.0, 2.0});
  visitor.number(
      {"end_margin", "1",
       "nearer to its end than so many standard deviations of its range a beam frees nothing, in "
       "maps and in lidar_grid: what is there may be what it hit. Freed up to the end (0: thesis), "
       "a surface keeps those of its noisy hits that lie behind it and loses those before it, so "
       "that all that comes into view is mapped too far away, and the pose drifts"},
      end_margin, {0.0, 10.0});
  visitor.number({"beam_width", "rad",
                  "opening angle of a beam, for lidar_grid; 0: it reaches half way to its "
                  "neighbors (thesis 3.2.1: each cell asks the nearest beam)",
                  Tier::kPublic},
                 beam_width, {0.0, 0.2});
  visitor.number({"max_tilt", "rad", "a scan plane tilted by more than this is warned of"},
                 max_tilt, {0.0, kPi / 2.0});
}

}  // namespace datmo
