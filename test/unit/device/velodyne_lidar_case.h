// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <cmath>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "device/velodyne_packets.h"
#include <gtest/gtest.h>

#include "datmo_fusion/device/velodyne_lidar.h"

namespace datmo::samples {

inline constexpr double kVelodyneStart = 1.7e9;  // s, when the computer's time is 0

struct SentPacket {
  double arrival = 0.0;  ///< s, of the computer
  std::string bytes;
};

/// Packets from a list; the recording ends with the list.
class ListedPackets : public PacketSource {
 public:
  ListedPackets(std::deque<SentPacket>& packets, double& now) : packets_(packets), now_(now) {}

  std::string_view next() override {
    if (packets_.empty()) {
      throw RecordingEnd("all sent");
    }
    current_ = std::move(packets_.front());
    packets_.pop_front();
    now_ = current_.arrival;
    return current_.bytes;
  }

 private:
  std::deque<SentPacket>& packets_;
  double& now_;
  SentPacket current_;
};

/// A lidar whose packets come from a list.
class VelodyneLidarTest : public testing::Test {
 protected:
  /// Packets of a lidar for this many turns, each up to `jitter` (s) late; `drift`: of its clock,
  /// s/s.
  void sendTurns(VelodyneStream& stream, double turns, double drift = 0.0, double jitter = 0.0) {
    const int count = static_cast<int>(std::lround(turns * stream.packetsPerTurn()));
    for (int i = 0; i < count; ++i) {
      send(stream, drift, jitter * (i % 4) / 3.0);
    }
  }

  void send(VelodyneStream& stream, double drift = 0.0, double late = 0.0) {
    // It arrives when it is complete, by the computer's clock since the stream's first second.
    const double done = (stream.time() * 1e-6 + stream.period() - 1.0) / (1.0 - drift) + late;
    packets_.push_back({done, stream.next()});
  }

  void connect() {
    lidar_.emplace([this] { return std::make_unique<ListedPackets>(packets_, now_); }, options_,
                   host_);
    name_ = lidar_->connect();
  }

  /// Returns all clouds until nothing more is sent.
  std::vector<DeviceMeasurement> clouds() {
    std::vector<DeviceMeasurement> all;
    try {
      while (true) {
        all.push_back(lidar_->next());
      }
    } catch (const RecordingEnd&) {
    }
    return all;
  }

  std::string faultOf() {
    try {
      while (true) {
        lidar_->next();
      }
    } catch (const DeviceError& error) {
      return error.reason();
    }
  }

  static double seconds(Stamp stamp) {
    return secondsBetween(Stamp::fromSeconds(kVelodyneStart), stamp);
  }

  static const std::vector<CloudPoint>& points(const DeviceMeasurement& measurement) {
    return std::get<DeviceCloud>(measurement.data).points;
  }

  double now_ = 0.0;
  std::deque<SentPacket> packets_;
  std::atomic<bool> stop_{false};
  DeviceClock clock_{ClockOptions(), [this] { return Stamp::fromSeconds(kVelodyneStart + now_); }};
  std::map<std::string, int> warnings_;
  DeviceHost host_{stop_, clock_,
                   [this](const DeviceError& error) { ++warnings_[error.reason()]; }};
  VelodyneOptions options_;
  std::optional<VelodyneLidar> lidar_;
  std::string name_;
};

}  // namespace datmo::samples
