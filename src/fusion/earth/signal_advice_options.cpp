// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/fusion/earth/signal_advice.h"

namespace datmo {

void SignalAdviceOptions::visit(OptionVisitor& visitor) {
  visitor.number(
      {"max_distance", "m", "distance to the stop line; V2X reaches 300 m to 500 m in cities"},
      max_distance, {10.0, 2000.0});
  visitor.number({"lane_width", "m", "lane width of an intersection that does not report it"},
                 lane_width, {1.0, 10.0});
  visitor.number({"bound", "1", "standard deviations within which the vehicle is assumed to be"},
                 bound, {0.0, 5.0});
  visitor.number({"time_margin", "s",
                  "margin before and after the arrival, for clocks that do not quite agree"},
                 time_margin, {0.0, 5.0});
  visitor.number({"stop_time", "s",
                  "how long yellow and red last at least after a green phase whose next lights are "
                  "not given: 3 s of yellow at 50 km/h and a red of some seconds (RiLSA 2015)"},
                 stop_time, {0.0, 60.0});
  visitor.number({"min_speed", "m/s", "a slower vehicle is stationary: it never arrives"},
                 min_speed, {0.1, 5.0});
  visitor.number(
      {"max_age", "s",
       "age of lights; older ones are ignored (ETSI TS 103 301: sent every 0.1 s to 1 s)"},
      max_age, {0.1, 60.0});
}

}  // namespace datmo
