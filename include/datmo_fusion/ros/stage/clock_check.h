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

/// Watches the clock of one input's sensor (SensorClock). While it is off, each message is warned
/// of (`clock_off`) and served with the stamp that it would have had. Messages that come before
/// their stamps are warned of (`clock_ahead`) and served as they are: the clock that is off may be
/// ours.
///
/// A clock that was set and is then taken for the right one is said (`clock_set`).
///
/// Each stage has a check of its own: the offset is a difference of stamps, which are the same for
/// all of them, but one that was started later, or that gets the messages at other times, may have
/// another clock for the right one, or find a step up to SensorClock::kRemembered messages later.
class ClockCheck {
 public:
  /// `monitor` must outlive it.
  ClockCheck(std::string input, StageMonitor& monitor)
      : input_(std::move(input)), monitor_(monitor) {}

  /// A message's stamp, put right; one that is none, or would not be a time then, as it is. `now`:
  /// ROS time at which it came.
  ros::Time corrected(const ros::Time& stamp, Stamp now);

 private:
  std::string input_;
  StageMonitor& monitor_;
  SensorClock clock_;
};

/// Returns `take` behind a check of the clock of the input's sensor: it gets the message itself, or
/// a copy with a corrected stamp. Nothing is checked in simulated time. `monitor` must outlive it.
template <typename Message, typename Take>
StagePorts::Take<Message> withClockCheck(const StagePorts& ports, const std::string& input,
                                         StageMonitor& monitor, Take take) {
  if (ports.hasSimulatedTime()) {
    return take;
  }
  const auto check = std::make_shared<ClockCheck>(input, monitor);
  return [check, take](const boost::shared_ptr<const Message>& message, Stamp now) {
    const ros::Time stamp = check->corrected(message->header.stamp, now);
    if (stamp == message->header.stamp) {
      take(message, now);
      return;
    }
    const auto copy = boost::make_shared<Message>(*message);
    copy->header.stamp = stamp;
    take(boost::shared_ptr<const Message>(copy), now);
  };
}

}  // namespace datmo
