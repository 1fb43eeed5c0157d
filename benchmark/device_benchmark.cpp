// SPDX-License-Identifier: BSD-3-Clause
// One revolution of a Velodyne lidar with 32 lasers and dual returns (138,880 points): packets to
// points, and points to a message.

#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include "datmo_fusion/device/velodyne_packet.h"
#include "datmo_fusion/ros/convert/device_conversion.h"

namespace datmo {
namespace {

constexpr int kTurnPackets = 362;

/// Two returns in every direction, at 10 m and 20 m.
std::string packetOfTwoReturns() {
  std::string bytes;
  const auto put = [&bytes](unsigned word) {
    bytes += static_cast<char>(word & 0xFFU);
    bytes += static_cast<char>(word >> 8U);
  };
  for (unsigned block = 0; block < VelodynePacket::kBlocks; ++block) {
    put(0xEEFF);
    put(9000 + 16 * (block / 2));
    for (std::size_t channel = 0; channel < VelodyneModel::kChannels; ++channel) {
      put(block % 2 == 0 ? 5000 : 10000);
      bytes += '\x40';
    }
  }
  return bytes + std::string(4, '\0') + "\x39\x21";
}

DeviceCloud decodedTurn(const std::string& bytes) {
  const VelodyneModel& lidar = velodyneModels().back();
  DeviceCloud cloud;
  cloud.points.reserve(kTurnPackets * VelodynePacket::kBlocks * VelodyneModel::kChannels);
  for (int i = 0; i < kTurnPackets; ++i) {
    const VelodynePacket packet(bytes);
    for (std::size_t block = 0; block < VelodynePacket::kBlocks; ++block) {
      appendPoints(packet, block, lidar, RangeLimits(), 0.0, cloud.points);
    }
  }
  return cloud;
}

void velodyneTurn(benchmark::State& state) {
  const std::string bytes = packetOfTwoReturns();
  std::size_t points = 0;
  for (auto _ : state) {
    points += decodedTurn(bytes).points.size();
  }
  state.SetItemsProcessed(static_cast<std::int64_t>(points));
}
BENCHMARK(velodyneTurn)->Unit(benchmark::kMillisecond);

void velodyneMessage(benchmark::State& state) {
  const DeviceCloud cloud = decodedTurn(packetOfTwoReturns());
  for (auto _ : state) {
    benchmark::DoNotOptimize(toMessage(cloud, Stamp(), "velodyne"));
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(cloud.points.size()));
}
BENCHMARK(velodyneMessage)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace datmo
