// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/grid/beam_end.h"

namespace datmo {

void BeamEndOptions::visit(OptionVisitor& visitor) {
  visitor.number({"range_sigma", "m", "standard deviation of the scanner's ranges; 0: not known"},
                 range_sigma, {0.0, 2.0});
  visitor.number({"end_margin", "1",
                  "a beam frees nothing within this many standard deviations of its range before "
                  "its end; 0: it is free up to its end (thesis)"},
                 end_margin, {0.0, 10.0});
}

}  // namespace datmo
