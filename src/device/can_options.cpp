// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/device/can_motion.h"

namespace datmo {

namespace {

/// Visits the options that define the signals.
void visitSignals(CanOptions& options, OptionVisitor& visitor) {
  visitor.text({"dbc", "", "DBC file that describes the messages of the bus; empty: none"},
               options.dbc, {});
  visitor.text({"speed", "",
                "signal of the vehicle's speed (m/s, km/h, mph): its name in the DBC file, or ID "
                "START|LENGTH@ORDER SIGN (FACTOR,OFFSET) [MIN|MAX] UNIT, as in such a file; empty: "
                "the mean of the wheels"},
               options.speed, {});
  const auto wheel = [&visitor](const char* name, const char* which, std::string& text) {
    visitor.text({name, "",
                  std::string("the same for the speed of the ") + which +
                      " wheel (the same units, or rad/s, rpm); empty: unknown"},
                 text, {});
  };
  wheel("front_left", "front left", options.front_left);
  wheel("front_right", "front right", options.front_right);
  wheel("rear_left", "rear left", options.rear_left);
  wheel("rear_right", "rear right", options.rear_right);
  visitor.text({"yaw_rate", "", "the same for the yaw rate (rad/s, deg/s), positive to the left"},
               options.yaw_rate, {});
  visitor.text(
      {"steering", "",
       "the same for the steering wheel (rad, deg), positive to the left; published as the "
       "angle of the front wheels (over steering_ratio), unless yaw_from is steering; "
       "empty: the bus has none"},
      options.steering, {});
  visitor.text({"direction", "",
                "the same for the gear or the direction of travel; empty: the speed has a sign, or "
                "the vehicle does not reverse"},
               options.direction, {});
  visitor.text(
      {"acceleration", "",
       "the same for the acceleration along the vehicle (m/s^2, g), positive ahead; empty: "
       "not published"},
      options.acceleration, {});
  visitor.text({"counter", "",
                "the same for the counter in the speed's message: while it does not change, the "
                "message is not used; empty: it has none"},
               options.counter, {});
  visitor.text({"yaw_counter", "", "the same for the message of the yaw rate or the steering"},
               options.yaw_counter, {});
}

}  // namespace

void CanOptions::visit(OptionVisitor& visitor) {
  constexpr double kCounterValues = 65536.0;
  visitSignals(*this, visitor);
  visitor.choice({"yaw_from", "",
                  "source of the yaw rate: its signal; the difference of the rear wheels; the "
                  "steering with the bicycle model; or none, if an Imu measures it"},
                 yaw_from,
                 Choices<CanYaw>{{"signal", CanYaw::kSignal},
                                 {"wheels", CanYaw::kWheels},
                                 {"steering", CanYaw::kSteering},
                                 {"none", CanYaw::kNone}});
  visitor.number({"reverse", "1", "value of `direction` while the vehicle reverses"}, reverse, {});
  visitor.number({"wheel_radius", "m", "radius of wheels whose speed is in rad/s or rpm"},
                 wheel_radius, {0.05, 2.0});
  visitor.number({"track_width", "m", "distance between the rear wheels, for yaw_from: wheels"},
                 track_width, {0.2, 4.0});
  visitor.number({"wheelbase", "m", "distance between the axles, for yaw_from: steering"},
                 wheelbase, {0.2, 20.0});
  visitor.number({"steering_ratio", "1",
                  "angle of the steering wheel over that of the road wheels, 12 to 20 for cars; 1: "
                  "the signal is the road wheels' angle"},
                 steering_ratio, {0.1, 50.0});
  visitor.number(
      {"max_age", "s",
       "maximum age of another message's signal at the time of the speed, as motion/hold"},
      max_age, {0.01, 10.0});
  visitor.number({"delay", "s",
                  "time from the measurement to the message on the bus: half the control unit's "
                  "filter and its cycle (its data sheet)"},
                 delay, {0.0, 1.0});
  visitor.integer({"counter_values", "1",
                   "number of values of the counters before they start over; 0: all of their bits "
                   "(AUTOSAR E2E profile 1: 15)"},
                  counter_values, {0.0, kCounterValues});
  visitor.integer(
      {"frozen_after", "1", "messages with the same counter after which it counts as frozen"},
      frozen_after, {1.0, 100.0});
}

}  // namespace datmo
