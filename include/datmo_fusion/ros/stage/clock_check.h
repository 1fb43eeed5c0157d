// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <utility>

#include <boost/make_shared.hpp>
#include <boost/shared_ptr.hpp>

#include "datmo_fusion/common/sensor_clock.h"
#include "datmo_fusion/ros/stage/stage.h"
#include "datmo_fusion/ros/stage/stage_monitor.h"
#include "datmo_fusion/ros/stage/stamp_check.h"

namespace datmo {

/// Monitors the clock of one input's sensor (SensorClock). While it is off, each message causes a
/// warning (`clock_off`) and is processed with the stamp that it would have had. Messages that
/// arrive before their stamps cause a warning (`clock_ahead`) and are processed unchanged: the
/// clock that is off may be ours.
///
/// A clock that was set and is accepted from then on is reported (`clock_set`).
///
/// Each stage has its own check: the offset is a difference of stamps, which are the same for all
/// stages, but one that was started later, or receives the messages at other times, may consider
/// another clock right, or detect a step up to SensorClock::kRemembered messages later.
class ClockCheck {
 public:
  /// `monitor` must outlive it.
  ClockCheck(std::string input, StageMonitor& monitor)
      : input_(std::move(input)), monitor_(monitor) {}

  /// Returns a message's corrected stamp; unchanged if it is zero, or if the result would not be a
  /// valid time. `now`: ROS time of its arrival.
  ros::Time corrected(const ros::Time& stamp, Stamp now);

 private:
  std::string input_;
  StageMonitor& monitor_;
  SensorClock clock_;
};

/// Returns `callback` behind a check of the clock of the input's sensor: it gets the message
/// itself, or a copy with a corrected stamp. Nothing is checked in simulated time, as the host says
/// when the input is declared. `monitor` must outlive it.
template <typename Message, typename Callback>
StagePorts::Callback<Message> withClockCheck(const StagePorts& ports, const std::string& input,
                                             StageMonitor& monitor, Callback callback) {
  if (ports.hasSimulatedTime()) {
    return callback;
  }
  const auto check = std::make_shared<ClockCheck>(input, monitor);
  return [check, callback](const boost::shared_ptr<const Message>& message, Stamp now) {
    const ros::Time stamp = check->corrected(message->header.stamp, now);
    if (stamp == message->header.stamp) {
      callback(message, now);
      return;
    }
    const auto copy = boost::make_shared<Message>(*message);
    copy->header.stamp = stamp;
    callback(boost::shared_ptr<const Message>(copy), now);
  };
}

}  // namespace datmo
