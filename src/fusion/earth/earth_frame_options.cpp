// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/fusion/earth/earth_frame_filter.h"

namespace datmo {

void EarthFrameOptions::visit(OptionVisitor& visitor) {
  visitor.number({"correlated_share", "1",
                  "share of a fix's variance that the fixes of correlation_time have in common "
                  "(atmosphere, multipath)"},
                 correlated_share, {0.0, 1.0});
  visitor.number({"correlation_time", "s", "time constant of that common error"}, correlation_time,
                 {0.1, 3600.0});
  visitor.number({"map_drift", "m / sqrt(m)", "how far the map drifts with the distance driven"},
                 map_drift, {0.0, 10.0});
  visitor.number({"map_turn", "rad / sqrt(m)", "how far the map turns with it"}, map_turn,
                 {0.0, 1.0});
  visitor.number({"gate", "1",
                  "squared Mahalanobis distance above which a fix is rejected; chi-square with two "
                  "degrees of freedom, 99.9 %"},
                 gate, {1.0, 1000.0});
  visitor.integer(
      {"restart_after", "", "after this many rejected fixes in a row the filter restarts"},
      restart_after, {1.0, 1000.0});
  visitor.number({"start_share", "1", "minimum share of the first fixes that are consistent"},
                 start_share, {0.5, 1.0});
  visitor.number(
      {"max_gap", "s",
       "after a longer time without a fix, the filter restarts if the next one is far off"},
      max_gap, {0.1, 3600.0});
}

}  // namespace datmo
