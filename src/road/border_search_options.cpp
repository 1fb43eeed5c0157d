// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/road/border_search.h"

namespace datmo {

void BorderSearchOptions::visit(OptionVisitor& visitor) {
  visitor.number({"length", "m", "length of a window, along the border (thesis 3.5: 20)"}, length,
                 {1.0, 200.0});
  visitor.number({"width", "m", "width of a window (thesis 3.5: 1)"}, width, {0.1, 10.0});
  visitor.number({"step", "m", "distance from one window to the next (thesis 3.5: 0.9)"}, step,
                 {0.05, 10.0});
  visitor.integer({"left_windows", "1", "windows on the left side (thesis 3.5: 25)"}, left_windows,
                  {1, 1000});
  visitor.integer({"right_windows", "1", "windows on the right side (thesis 3.5: 15)"},
                  right_windows, {1, 1000});
  visitor.number({"heading_range", "rad",
                  "windows are also rotated by up to this, since the vehicle changes lanes and "
                  "roads bend; 0: parallel to the vehicle only (thesis 3.5)"},
                 heading_range, {0.0, 1.0});
  visitor.integer(
      {"sections", "1", "sections along a window, whose share that is hit is the score"}, sections,
      {1, 64});
  visitor.choice(
      {"score", "",
       "share: fraction of the sections of a window with a cell above the cut, which is the same "
       "for any speed and scanner; hits: the sum over all cells (thesis 3.5.3)"},
      score, {{"share", BorderScore::kShare}, {"hits", BorderScore::kHits}});
  visitor.number({"min_share", "1", "minimum score of a border, if score is share"}, min_share,
                 {0.0, 1.0});
  visitor.number({"min_hits", "1", "minimum score of a border, if score is hits"}, min_hits,
                 {0.0, 1.0e9});
  visitor.choice({"take", "",
                  "first: the nearest window with the score of a border whose next window does not "
                  "score higher; highest: the window with the highest score (thesis 3.5 has both)"},
                 take, {{"first", BorderChoice::kFirst}, {"highest", BorderChoice::kHighest}});
}

}  // namespace datmo
