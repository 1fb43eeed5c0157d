// SPDX-License-Identifier: BSD-3-Clause
#include "device/velodyne_packets.h"

#include <cmath>

#include "datmo_fusion/device/velodyne_packet.h"

namespace datmo::samples {

namespace {

void putWord(std::string& bytes, unsigned word) {
  bytes += static_cast<char>(word & 0xFFU);
  bytes += static_cast<char>(word >> 8U);
}

const VelodyneModel& model(std::uint8_t product) {
  for (const VelodyneModel& one : velodyneModels()) {
    if (one.product == product) {
      return one;
    }
  }
  return velodyneModels().front();
}

}  // namespace

std::string VelodyneSample::bytes() const {
  std::string bytes;
  for (unsigned block = 0; block < VelodynePacket::kBlocks; ++block) {
    const bool is_second = returns == kDual && block % 2 == 1;
    const auto& ranges = is_second ? second_distances : distances;
    putWord(bytes, 0xEEFF);
    putWord(bytes,
            (azimuth + step * (returns == kDual ? block / 2 : block)) % VelodynePacket::kFullTurn);
    for (std::size_t channel = 0; channel < VelodyneModel::kChannels; ++channel) {
      putWord(bytes, ranges[channel % ranges.size()]);
      bytes += static_cast<char>(intensity);
    }
  }
  putWord(bytes, time & 0xFFFFU);
  putWord(bytes, time >> 16U);
  bytes += static_cast<char>(returns);
  bytes += static_cast<char>(product);
  return bytes;
}

int VelodyneStream::firings() const {
  const auto blocks = static_cast<int>(VelodynePacket::kBlocks);
  return sample_.returns == kDual ? blocks / 2 : blocks;
}

double VelodyneStream::period() const { return model(sample_.product).blockTime() * firings(); }

int VelodyneStream::packetsPerTurn() const {
  const auto turned = sample_.step * static_cast<unsigned>(firings());
  return static_cast<int>(VelodynePacket::kFullTurn / turned);
}

std::string VelodyneStream::next() {
  constexpr double kHour = 3.6e9;  // us
  const VelodyneModel& lidar = model(sample_.product);
  const double stamped =
      time_ + (lidar.stamped_last ? 1e6 * packetSpan(lidar, sample_.returns == kDual) : 0.0);
  sample_.time = static_cast<std::uint32_t>(std::fmod(std::round(stamped), kHour));
  std::string bytes = sample_.bytes();
  skip(1);
  return bytes;
}

void VelodyneStream::skip(int packets) {
  time_ += 1e6 * period() * packets;
  sample_.azimuth = (sample_.azimuth + sample_.step * static_cast<unsigned>(firings() * packets)) %
                    VelodynePacket::kFullTurn;
}

}  // namespace datmo::samples
