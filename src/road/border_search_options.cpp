// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/road/border_search.h"

namespace datmo {

void BorderSearchOptions::visit(OptionVisitor& visitor) {
  visitor.number({"length", "m", "of a window, along the border (thesis 3.5: 20)"}, length,
                 {1.0, 200.0});
  visitor.number({"width", "m", "of a window (thesis 3.5: 1)"}, width, {0.1, 10.0});
  visitor.number({"first_distance", "m",
                  "from the vehicle to the middle line of the first window (thesis 3.5: 1)"},
                 first_distance, {0.0, 50.0});
  visitor.number({"step", "m", "from a window to the next one (thesis 3.5: 0.9)"}, step,
                 {0.05, 10.0});
  visitor.integer({"left_windows", "1", "on the left side (thesis 3.5: 25)"}, left_windows,
                  {1, 1000});
  visitor.integer({"right_windows", "1", "on the right side (thesis 3.5: 15)"}, right_windows,
                  {1, 1000});
  visitor.number({"heading_range", "rad",
                  "windows are also turned by up to this, as the vehicle changes lanes and roads "
                  "bend; 0: along the vehicle only (thesis 3.5)"},
                 heading_range, {0.0, 1.0});
  visitor.number({"heading_step", "rad",
                  "between turned windows: a line at half of it to a window should not leave it"},
                 heading_step, {0.005, 0.5});
  visitor.integer({"sections", "1", "of the length of a window, for the share of it that is hit"},
                  sections, {1, 64});
  visitor.choice(
      {"score", "",
       "share: of the sections of a window that hold a cell that passes the cut, which is "
       "the same for any speed and scanner; or hits: the sum over all cells (thesis "
       "3.5.3)"},
      score, {{"share", BorderScore::kShare}, {"hits", BorderScore::kHits}});
  visitor.number({"min_share", "1", "of a border, where the score is share"}, min_share,
                 {0.0, 1.0});
  visitor.number({"min_hits", "1", "of a border, where the score is hits"}, min_hits, {0.0, 1.0e9});
  visitor.choice({"take", "",
                  "first: of the windows that are a border's by their score the nearest one whose "
                  "next one has no higher score; or highest: of all (thesis 3.5 has both)"},
                 take, {{"first", BorderChoice::kFirst}, {"highest", BorderChoice::kHighest}});
  visitor.number({"hit_sigma", "m", "of the hits about the border, by range noise"}, hit_sigma,
                 {0.01, 2.0});
  visitor.number({"shape_sigma", "m", "of the border about a straight line"}, shape_sigma,
                 {0.0, 2.0});
}

}  // namespace datmo
