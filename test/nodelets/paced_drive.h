// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "chain.h"

namespace datmo {

/// Rates that a PacedDrive sends at, Hz; 0: none.
struct PacedRates {
  double motion = 0.0;
  double scans = 0.0;
  double clouds = 0.0;
  int pixel_step = World::kPixelStep;  ///< 1: a point for each pixel
  double object_lists = 0.0;           ///< as of a stereo camera
  int objects = 0;                     ///< in each list
  double cloud_delay = 0.0;            ///< s, from the exposure until the cloud is sent
};

/// A drive through an endless World in real time, whether the nodelets keep up or not; records when
/// which output arrives, and the resources of their process. Without simulated time, stamps are the
/// computer's time.
class PacedDrive : public StereoChain {
 public:
  /// A list of tracks: its latency on arrival.
  struct Received {
    double at = 0.0;       ///< s, since the start
    double latency = 0.0;  ///< s
    std::size_t tracks = 0;
    std::uint32_t car = 0;  ///< id of the other car's track; 0: none
  };
  struct Memory {
    double at = 0.0;        ///< s, since the start
    double resident = 0.0;  ///< MiB
  };

  PacedDrive() : StereoChain(World(World::Length::kEndless)) {}

  /// Waits until the nodelets are subscribed, and those named here report; then starts the clock.
  bool start(const std::vector<std::string>& names);

  /// Returns the time since the start, s.
  double now() const { return (ros::SteadyTime::now() - start_).toSec(); }

  /// Continues the drive for this long, or until the condition holds; returns whether it did.
  bool run(
      double seconds, const PacedRates& rates,
      const std::function<bool()>& until = [] { return false; });

  /// Returns the number of messages sent on a topic.
  std::size_t sent(const std::string& topic) const;

  const std::vector<Received>& received() const { return received_; }
  const std::vector<Memory>& memory() const { return memory_; }

 private:
  void begin();
  /// Returns whether a message with this rate is due; counts it.
  bool isDue(const std::string& topic, double rate);
  void sendDue(const PacedRates& rates);
  void sampleMemory();
  void forget();
  std::uint32_t carIn(const TrackArray& list) const;

  ros::NodeHandle node_;
  ros::Publisher objects_;
  ros::Subscriber tracks_;
  ros::SteadyTime start_;
  std::map<std::string, double> next_;  ///< s, when a topic is due again
  std::map<std::string, std::size_t> sent_;
  std::vector<Received> received_;
  std::vector<Memory> memory_;
  pid_t process_ = 0;  ///< of the nodelets
};

}  // namespace datmo
