// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/grid/occupancy_map.h"

namespace datmo {

void OccupancyMapOptions::visit(OptionVisitor& visitor) {
  window.visit(visitor);
  visitor.number(
      {"hit_probability", "1", "occupancy of a cell in which a beam ends (thesis 3.2.1: 0.8)"},
      hit_probability, {0.51, 0.99});
  visitor.number({"free_probability", "1",
                  "occupancy of a cell that a beam passes (thesis 3.2.1: 0.2; weaker here, because "
                  "a beam of a poor scanner passes close to obstacles that it does not see)"},
                 free_probability, {0.01, 0.49});
  visitor.number({"min_probability", "1",
                  "a cell's occupancy stays between this and 1 - this, so that the map can change "
                  "its mind (Hess et al. 2016)"},
                 min_probability, {0.0001, 0.3});
  visitor.number(
      {"beam_width", "rad",
       "opening angle in which a beam is free up to its end (thesis 3.2.1: the spacing of "
       "the beams); 0: along the beam alone"},
      beam_width, {0.0, 0.2});
  visitor.number({"surface_sigma", "m",
                  "a beam that passes beside the surface in a cell frees the cell only as far as "
                  "it would have hit that surface, whose position has this standard deviation "
                  "(normal distributions occupancy map: Saarinen et al. 2013); 0: always (thesis)",
                  Tier::kPublic},
                 surface_sigma, {0.0, 2.0});
  beam_end.visit(visitor);
  visitor.number({"moving_below", "1",
                  "an end point in a cell less occupied than this is moving (thesis 3.3.1: 0.5)"},
                 moving_below, {0.01, 0.5});
  visitor.number({"static_after", "s",
                  "minimum time between the first and the last hit of a static cell: longer than a "
                  "moving object takes to pass over it (thesis: 0)"},
                 static_after, {0.0, 60.0});
  visitor.integer({"static_neighborhood", "cells",
                   "a static cell this close to an end point makes it static: range noise and pose "
                   "error (thesis: 0)"},
                  static_neighborhood, {0, 5});
  visitor.integer(
      {"ghost_after", "1",
       "where other sensors have refuted this many end points, the scanner sees something that is "
       "not an obstacle: end points there are not moving; 0: forgets them"},
      ghost_after, {0, 1000});
  visitor.integer(
      {"max_tiles", "1",
       "tiles (32 x 32 cells, 61 kB each) that the window has left and that are kept in memory for "
       "save_map; beyond this number, the first ones are written to a file"},
      max_tiles, {1, 1000000});
  visitor.group("tile_file", [&] { tile_file.visit(visitor); });
}

}  // namespace datmo
