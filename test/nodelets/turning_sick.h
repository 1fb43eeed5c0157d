// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "device/fake_sick.h"
#include "world.h"

#include <ros/time.h>
#include <sensor_msgs/LaserScan.h>

namespace datmo {

/// A SICK LMS151 on loopback that turns in real time, in a thread of its own, on the vehicle of an
/// endless World: 541 beams over 270 degrees, each measured at its own time. A scan is sent when
/// its last beam has been measured; its number is in the remission of the first beams.
class TurningSick {
 public:
  /// `rate`: turns per second.
  TurningSick(int port, double rate);
  ~TurningSick();
  TurningSick(const TurningSick&) = delete;
  TurningSick& operator=(const TurningSick&) = delete;

  /// Waits for the computer that uses it.
  void connect();

  /// Begins to measure. `now`: the time of the drive, s; called in the thread.
  void begin(std::function<double()> now);

  /// Ends with the current scan.
  void stop();

  /// Returns when each scan was sent, in the order of their numbers: just before its only packet.
  std::vector<ros::SteadyTime> departures() const;

  /// Returns the number of a scan as received.
  static std::size_t numberOf(const sensor_msgs::LaserScan& scan);

 private:
  void turn();
  samples::SickTelegram telegramAt(double seconds) const;

  samples::FakeSick device_;
  std::uint32_t frequency_;  ///< 0.01 Hz
  Sweep sweep_;
  World world_{World::Length::kEndless};
  std::function<double()> now_;
  std::uint32_t scans_ = 0;

  mutable std::mutex mutex_;  ///< for those below
  std::condition_variable stopped_;
  bool stop_ = false;
  std::vector<ros::SteadyTime> departures_;

  std::thread thread_;
};

}  // namespace datmo
