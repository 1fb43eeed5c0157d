// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/device_diagnostics.h"

#include <algorithm>
#include <variant>

#include "datmo_fusion/ros/stage/input_error.h"
#include "datmo_fusion/ros/stage/stamp_check.h"

namespace datmo {

namespace {

/// Velocities accompany positions, but have their own rate.
const char* inputOf(const DeviceData& data) {
  return std::holds_alternative<GroundVelocity>(data) ? "velocities" : "measurements";
}

/// The unit a device sends, of which some may be missing; empty if unknown.
std::string partOf(const DeviceData& data) {
  return std::holds_alternative<DeviceScan>(data)     ? "scans"
         : std::holds_alternative<DeviceCloud>(data)  ? "packets"
         : std::holds_alternative<VehicleTwist>(data) ? "frames"
                                                      : "";
}

}  // namespace

DeviceDiagnostics::DeviceDiagnostics(StageMonitor& monitor) : monitor_(monitor) {
  monitor_.condition(HealthLevel::kNoOutput, "not connected yet");
}

void DeviceDiagnostics::connected(const std::string& device, Stamp now) {
  monitor_.setTime(now);
  monitor_.figure("connections", static_cast<double>(++connections_));
  first_offset_.reset();
  last_twist_.reset();
  longest_gap_ = 0.0;
  monitor_.condition(HealthLevel::kOk, "connected to " + device);
}

void DeviceDiagnostics::fault(const DeviceError& error, Stamp now) {
  monitor_.setTime(now);
  monitor_.dropped(InputError(error.reason(), error.what()));
  monitor_.condition(HealthLevel::kNoOutput, error.what());
}

void DeviceDiagnostics::warning(const DeviceError& error, Stamp now) {
  monitor_.setTime(now);
  monitor_.warned(InputError(error.reason(), error.what()));
}

void DeviceDiagnostics::measured(const DeviceMeasurement& measurement, const ClockState& clock,
                                 std::uint64_t discarded, Stamp now) {
  monitor_.setTime(now);
  checkHasBegun(std::min(measurement.stamp, now));
  const std::string input = inputOf(measurement.data);
  monitor_.received(input, now);
  noteMissed(measurement);
  if (const auto* const fix = std::get_if<SatelliteFix>(&measurement.data)) {
    monitor_.figure("satellites", fix->satellites);
    monitor_.figure("standard deviation [m]", fix->sigma);
  }
  if (const auto* const twist = std::get_if<VehicleTwist>(&measurement.data)) {
    noteBus(*twist, measurement.stamp);
  }
  noteClock(clock);
  monitor_.figure("measurements discarded", static_cast<double>(discarded));
  if (!std::holds_alternative<GroundVelocity>(measurement.data)) {
    monitor_.figure("rate [Hz]", monitor_.input(input, now).rate);
  }
}

void DeviceDiagnostics::noteMissed(const DeviceMeasurement& measurement) {
  const std::string part = partOf(measurement.data);
  if (part.empty()) {
    return;
  }
  missed_ += measurement.missed;
  if (measurement.missed > 0) {
    monitor_.warned(InputError("missed_" + part, std::to_string(measurement.missed) + " " + part +
                                                     " were lost before this one: expected none; "
                                                     "is the network or the computer overloaded?"));
  }
  monitor_.figure(part + " missed", static_cast<double>(missed_));
}

void DeviceDiagnostics::noteBus(const VehicleTwist& twist, Stamp stamp) {
  if (last_twist_) {
    longest_gap_ = std::max(longest_gap_, secondsBetween(*last_twist_, stamp));
  }
  last_twist_ = stamp;
  monitor_.figure("longest gap since connected [s]", longest_gap_);
  monitor_.figure("frames of other messages", static_cast<double>(twist.other_frames));
}

void DeviceDiagnostics::noteClock(const ClockState& clock) {
  constexpr double kPartsPerMillion = 1e6;
  constexpr double kMilliseconds = 1e3;
  if (clock.steps > clock_steps_) {
    monitor_.warned(InputError("clock_step",
                               "the device's clock or the computer's was set: stamps start over"));
  }
  clock_steps_ = clock.steps;
  // The device's clock has an arbitrary origin: only its drift is informative.
  first_offset_ = first_offset_.value_or(clock.offset);
  monitor_.figure("clock offset since connected [ms]",
                  kMilliseconds * (clock.offset - *first_offset_));
  monitor_.figure("clock drift [ppm]", clock.drift * kPartsPerMillion);
  monitor_.figure("clock steps", static_cast<double>(clock_steps_));
}

}  // namespace datmo
