// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/common/stamp.h"
#include "datmo_fusion/device/can_signal.h"
#include "datmo_fusion/device/device_data.h"
#include "datmo_fusion/device/device_error.h"

namespace datmo {

enum class CanQuantity;

/// Source of the yaw rate.
enum class CanYaw { kSignal, kWheels, kSteering, kNone };

/// Signals of a vehicle's CAN bus that give its motion. A signal is written as its id and its
/// definition in a DBC file, `0x1A0 8|16@1+ (0.01,0) [0|250] "km/h"`, or its name in the DBC file;
/// empty: the bus has none.
struct CanOptions {
  std::string dbc;
  std::string speed;
  std::string front_left;
  std::string front_right;
  std::string rear_left;
  std::string rear_right;
  std::string yaw_rate;
  std::string steering;
  std::string direction;
  std::string acceleration;
  std::string counter;
  std::string yaw_counter;
  CanYaw yaw_from = CanYaw::kSignal;
  double reverse = 1.0;
  double wheel_radius = 0.3;     ///< m
  double track_width = 1.5;      ///< m
  double wheelbase = 2.7;        ///< m
  double steering_ratio = 15.0;  ///< 1
  double max_age = 0.5;          ///< s
  double delay = 0.0;            ///< s
  int counter_values = 0;
  int frozen_after = 3;

  void visit(OptionVisitor& visitor);

  /// Whether the steering is published: it tells nothing more if the yaw rate is derived from it.
  bool publishesSteering() const { return !steering.empty() && yaw_from != CanYaw::kSteering; }
};

/// Computes the vehicle's motion from the frames of its CAN bus. Each frame with the speed (the
/// last wheel's frame if the speed is that of the wheels) gives one motion, with the newest values
/// of the other signals; steering and acceleration are passed on once, with their own stamps.
class CanMotion {
 public:
  /// Reports a faulty frame, which is ignored.
  using Warn = std::function<void(const DeviceError& error)>;

  /// Throws OptionError for missing or invalid signals.
  CanMotion(const Checked<CanOptions>& options, Warn warn);

  struct Motion {
    VehicleTwist twist;
    std::uint64_t missed = 0;  ///< frames by their counter, since the last one
  };
  /// Processes a frame that was received at the stamp, but not an error frame. Returns a motion if
  /// the frame completes one. Warns of `bad_frame` (too short), `bad_signal` (out of its limits),
  /// `frozen_counter`, `stale_signal`.
  std::optional<Motion> update(const CanFrame& frame, Stamp stamp);

  /// Returns the id of the message that sets the pace, in readable form.
  std::string paceText() const { return toText(pace_); }

  /// Number of frames without any of the signals, so far.
  std::uint64_t otherFrames() const { return other_frames_; }

 private:
  /// What a signal measures; wheels from the front left one on.
  enum Role { kSpeed, kYawRate, kSteering, kDirection, kAcceleration, kWheel, kRoles = kWheel + 4 };

  struct Channel {
    CanSignal signal;
    double scale = 1.0;  ///< of a value of the signal, to m, s and rad
    std::optional<double> value;
    Stamp stamp;          ///< of the value
    bool is_new = false;  ///< it has not been passed on by takeNew
  };

  /// The rolling counter of a message.
  struct Counter {
    CanSignal signal;
    std::optional<std::uint64_t> last;
    int repeats = 0;
    bool is_frozen = true;  ///< until it has changed
  };

  void add(Role role, const char* name, const std::string& text, CanQuantity quantity);
  /// Adds the counter of a message with one of the signals of these roles.
  void addCounter(const char* name, const std::string& text, int first, int last);
  void check() const;
  bool isCounting(const CanFrame& frame);
  bool step(Counter& counter, std::uint64_t value);
  void read(Role role, const CanFrame& frame, Stamp stamp);
  /// Returns the value if there is one and it is not older than `max_age`.
  std::optional<double> fresh(int role, Stamp stamp) const;
  /// The same of a signal that there is; otherwise warns and returns none.
  std::optional<double> newest(int role, Stamp stamp) const;
  std::optional<double> speedAt(Stamp stamp) const;
  std::optional<double> yawRateAt(Stamp stamp, double speed) const;
  /// Returns the value times `scale`, with its own stamp, once: none until there is a new one.
  std::optional<StampedValue> takeNew(Role role, double scale);

  CanOptions options_;
  Warn warn_;
  std::array<std::optional<Channel>, kRoles> channels_;
  std::vector<Counter> counters_;
  CanId pace_;
  std::uint64_t other_frames_ = 0;
  std::uint64_t missed_ = 0;
};

}  // namespace datmo
