// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/device/can_motion.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "can_units.h"

#include "datmo_fusion/device/can_database.h"

namespace datmo {

namespace {

constexpr std::array<const char*, 9> kSignalNames = {"speed",       "yaw_rate",     "steering",
                                                     "direction",   "acceleration", "front_left",
                                                     "front_right", "rear_left",    "rear_right"};

std::string optionName(const std::string& option) { return "can/" + option; }

}  // namespace

CanMotion::CanMotion(const Checked<CanOptions>& options, Warn warn)
    : options_(*options), warn_(std::move(warn)) {
  add(kSpeed, "speed", options_.speed, CanQuantity::kSpeed);
  add(kYawRate, "yaw_rate", options_.yaw_rate, CanQuantity::kYawRate);
  add(kSteering, "steering", options_.steering, CanQuantity::kSteeringAngle);
  add(kDirection, "direction", options_.direction, CanQuantity::kDirection);
  add(kAcceleration, "acceleration", options_.acceleration, CanQuantity::kAcceleration);
  const std::array<const std::string*, 4> wheels = {&options_.front_left, &options_.front_right,
                                                    &options_.rear_left, &options_.rear_right};
  for (std::size_t i = 0; i < wheels.size(); ++i) {
    add(static_cast<Role>(kWheel + i), kSignalNames[kWheel + i], *wheels[i],
        CanQuantity::kWheelSpeed);
  }
  check();
  addCounter("counter", options_.counter, channels_[kSpeed] ? kSpeed : kWheel,
             channels_[kSpeed] ? kSpeed : kRoles - 1);
  addCounter("yaw_counter", options_.yaw_counter, kYawRate, kSteering);
  for (const auto& channel : channels_) {  // the speed's own, or that of the last wheel
    const auto role = &channel - channels_.data();
    const bool is_speed = channels_[kSpeed] ? role == kSpeed : role >= kWheel;
    pace_ = channel && is_speed ? channel->signal.id : pace_;
  }
}

void CanMotion::add(Role role, const char* name, const std::string& text, CanQuantity quantity) {
  if (text.empty()) {
    return;
  }
  Channel channel;
  channel.signal = canSignalFrom(optionName(name), text, options_.dbc);
  const std::string& unit = channel.signal.unit;
  const Units units = quantity == CanQuantity::kDirection
                          ? Units{{unit, 1.0}}
                          : unitsOf(quantity, options_.wheel_radius);
  const auto found = units.find(unit);
  if (found == units.end()) {
    std::string known;
    for (const auto& [one, scale] : units) {
      known += one.front() == '\xB0' ? "" : (known.empty() ? "" : ", ") + one;
    }
    throw OptionError(optionName(name) + " is in '" + unit + "': expected one of " + known);
  }
  channel.scale = found->second;
  channels_[role] = channel;
}

void CanMotion::addCounter(const char* name, const std::string& text, int first, int last) {
  if (text.empty()) {
    return;
  }
  Counter counter;
  counter.signal = canSignalFrom(optionName(name), text, options_.dbc);
  std::string guarded;
  bool is_guard = false;
  for (int role = first; role <= last; ++role) {
    if (channels_[role]) {
      is_guard = is_guard || channels_[role]->signal.id == counter.signal.id;
      guarded += (guarded.empty() ? "" : ", ") + toText(channels_[role]->signal.id) + " of " +
                 optionName(kSignalNames[role]);
    }
  }
  if (!is_guard) {
    throw OptionError(optionName(name) + " is in the message " + toText(counter.signal.id) +
                      ": expected that of the signals that it protects, " +
                      (guarded.empty() ? "of which there are none" : guarded));
  }
  counters_.push_back(counter);
}

void CanMotion::check() const {
  const auto require = [this](Role role, const char* why) {
    if (!channels_[role]) {
      throw OptionError(optionName(kSignalNames[role]) + " is empty: expected a signal, " + why);
    }
  };
  if (std::none_of(channels_.begin() + kWheel, channels_.end(),
                   [](const auto& wheel) { return wheel.has_value(); })) {
    require(kSpeed, "or those of the wheels");
  }
  if (options_.yaw_from == CanYaw::kSignal) {
    require(kYawRate, "or another can/yaw_from");
  } else if (options_.yaw_from == CanYaw::kSteering) {
    require(kSteering, "for can/yaw_from: steering");
  } else if (options_.yaw_from == CanYaw::kWheels) {
    require(static_cast<Role>(kWheel + 2), "for can/yaw_from: wheels");
    require(static_cast<Role>(kWheel + 3), "for can/yaw_from: wheels");
  }
}

std::optional<CanMotion::Motion> CanMotion::update(const CanFrame& frame, Stamp stamp) {
  if (!isCounting(frame)) {
    return std::nullopt;
  }
  bool is_ours = false;
  for (int role = 0; role < kRoles; ++role) {
    if (channels_[role] && channels_[role]->signal.id == frame.id) {
      read(static_cast<Role>(role), frame, stamp);
      is_ours = true;
    }
  }
  other_frames_ += is_ours ? 0 : 1;
  if (!is_ours || !(frame.id == pace_)) {
    return std::nullopt;
  }
  const std::optional<double> speed = speedAt(stamp);
  const std::optional<double> yaw_rate = speed ? yawRateAt(stamp, *speed) : std::nullopt;
  if (!yaw_rate) {
    return std::nullopt;
  }
  Motion motion{{*speed, *yaw_rate, other_frames_, {}, takeNew(kAcceleration, 1.0)},
                std::exchange(missed_, 0)};
  if (options_.publishesSteering()) {
    motion.twist.steering = takeNew(kSteering, 1.0 / options_.steering_ratio);
  }
  return motion;
}

bool CanMotion::isCounting(const CanFrame& frame) {
  for (Counter& counter : counters_) {
    if (!(counter.signal.id == frame.id)) {
      continue;
    }
    const std::optional<std::uint64_t> value = counter.signal.raw(frame);
    if (!value) {
      warn_({"bad_frame", toText(frame.id) + " with " + std::to_string(frame.size) +
                              " bytes: expected " + std::to_string(counter.signal.bytes()) +
                              " for its counter"});
      return false;
    }
    if (!step(counter, *value)) {
      return false;
    }
  }
  return true;
}

bool CanMotion::step(Counter& counter, std::uint64_t value) {
  const bool is_first = !counter.last.has_value();
  const std::uint64_t last = std::exchange(counter.last, value).value_or(value);
  if (value == last) {
    counter.repeats = is_first ? 0 : counter.repeats + 1;
    counter.is_frozen = counter.is_frozen || counter.repeats >= options_.frozen_after;
    if (counter.is_frozen && !is_first) {
      warn_({"frozen_counter",
             toText(counter.signal.id) + " repeats its counter, " + std::to_string(value) +
                 ": expected one that changes; the message is not used until then"});
    }
    return !counter.is_frozen;
  }
  const std::uint64_t mask = counter.signal.length < 64
                                 ? (std::uint64_t{1} << counter.signal.length) - 1
                                 : ~std::uint64_t{0};
  const auto values = static_cast<std::uint64_t>(options_.counter_values);
  const std::uint64_t steps =
      values == 0 ? (value - last) & mask : (value % values + values - last % values) % values;
  missed_ += counter.signal.id == pace_ && steps > 0 ? steps - 1 : 0;
  counter.repeats = 0;
  counter.is_frozen = false;
  return true;
}

void CanMotion::read(Role role, const CanFrame& frame, Stamp stamp) {
  Channel& channel = *channels_[role];
  const std::optional<double> value = channel.signal.value(frame);
  channel.value.reset();
  if (!value) {
    warn_({"bad_frame", toText(frame.id) + " with " + std::to_string(frame.size) +
                            " bytes: expected " + std::to_string(channel.signal.bytes()) +
                            " for the signal " + optionName(kSignalNames[role])});
  } else if (!channel.signal.isInLimits(*value)) {
    warn_({"bad_signal", optionName(kSignalNames[role]) + " is " + std::to_string(*value) + " " +
                             channel.signal.unit + ": expected " +
                             std::to_string(channel.signal.min) + " to " +
                             std::to_string(channel.signal.max)});
  } else {
    channel.value = *value * channel.scale;
    channel.stamp = stamp;
    channel.is_new = true;
  }
}

std::optional<double> CanMotion::fresh(int role, Stamp stamp) const {
  const std::optional<Channel>& channel = channels_[role];
  return channel && std::abs(secondsBetween(channel->stamp, stamp)) <= options_.max_age
             ? channel->value
             : std::nullopt;
}

std::optional<double> CanMotion::newest(int role, Stamp stamp) const {
  if (const std::optional<double> value = fresh(role, stamp)) {
    return value;
  }
  const Channel& channel = *channels_[role];
  if (!(channel.signal.id == pace_)) {  // otherwise the fault has already been reported
    warn_({"stale_signal", optionName(kSignalNames[role]) + " (" + toText(channel.signal.id) +
                               ") has had no valid value for " + std::to_string(options_.max_age) +
                               " s: expected one with each speed; there is no motion without it"});
  }
  return std::nullopt;
}

std::optional<double> CanMotion::speedAt(Stamp stamp) const {
  double sum = 0.0;
  int count = 0;
  for (int role = channels_[kSpeed] ? kSpeed : kWheel; role < kRoles; ++role) {
    if (channels_[role]) {
      const std::optional<double> value = newest(role, stamp);
      if (!value) {
        return std::nullopt;
      }
      sum += *value;
      ++count;
    }
    if (role == kSpeed) {
      break;
    }
  }
  if (!channels_[kDirection]) {
    return sum / count;
  }
  const std::optional<double> direction = newest(kDirection, stamp);
  if (!direction) {
    return std::nullopt;
  }
  constexpr double kSame = 1e-6;
  return std::abs(*direction - options_.reverse) < kSame ? -std::abs(sum / count) : sum / count;
}

std::optional<StampedValue> CanMotion::takeNew(Role role, double scale) {
  std::optional<Channel>& channel = channels_[role];
  if (!channel || !std::exchange(channel->is_new, false) || !channel->value) {
    return std::nullopt;
  }
  return StampedValue{*channel->value * scale, channel->stamp};
}

std::optional<double> CanMotion::yawRateAt(Stamp stamp, double speed) const {
  switch (options_.yaw_from) {
    case CanYaw::kSignal:
      return newest(kYawRate, stamp);
    case CanYaw::kWheels: {
      const std::optional<double> left = newest(kWheel + 2, stamp);
      const std::optional<double> right = newest(kWheel + 3, stamp);
      if (!left || !right) {
        return std::nullopt;
      }
      const bool is_unsigned_reverse = speed < 0.0 && *left + *right > 0.0;
      return (is_unsigned_reverse ? *left - *right : *right - *left) / options_.track_width;
    }
    case CanYaw::kSteering: {
      const std::optional<double> angle = newest(kSteering, stamp);
      return angle ? std::optional<double>(speed * std::tan(*angle / options_.steering_ratio) /
                                           options_.wheelbase)
                   : std::nullopt;
    }
    case CanYaw::kNone:
      break;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace datmo
