// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/device/velodyne_packet.h"

#include <cmath>
#include <string>

#include "datmo_fusion/common/angle.h"
#include "datmo_fusion/device/device_error.h"

namespace datmo {

namespace {

constexpr std::size_t kBlockSize = 100;
constexpr std::size_t kBlockHead = 4;  ///< flag and azimuth
constexpr std::size_t kChannelSize = 3;
constexpr std::size_t kTimeAt = VelodynePacket::kBlocks * kBlockSize;
constexpr std::size_t kReturnAt = 1204;
constexpr std::size_t kProductAt = 1205;
constexpr unsigned kUpperBlock = 0xEEFF;
constexpr unsigned kLowerBlock = 0xDDFF;
constexpr unsigned char kDualReturn = 0x39;
constexpr unsigned kByte = 8;

constexpr double kAzimuthUnit = 0.01;  // deg

}  // namespace

VelodynePacket::VelodynePacket(std::string_view bytes) : bytes_(bytes) {
  if (bytes.size() != kSize) {
    throw DeviceError("bad_packet", "a packet of " + std::to_string(bytes.size()) +
                                        " bytes: expected " + std::to_string(kSize) +
                                        ", a Velodyne lidar's");
  }
  for (std::size_t block = 0; block < kBlocks; ++block) {
    const unsigned flag = wordAt(block * kBlockSize);
    if (flag == kLowerBlock) {
      throw DeviceError(
          "wrong_device",
          "the lidar has two kinds of blocks, as an HDL-64E, whose calibration is its "
          "own: expected a VLP-16, Puck LITE, Puck Hi-Res, VLP-32C or HDL-32E");
    }
    if (flag != kUpperBlock || azimuth(block) >= kFullTurn) {
      throw DeviceError("bad_packet", "block " + std::to_string(block) +
                                          " of a packet begins with " + std::to_string(flag) +
                                          " at azimuth " + std::to_string(azimuth(block)) +
                                          ": expected 61183 and less than 36000");
    }
  }
}

unsigned VelodynePacket::wordAt(std::size_t at) const {
  return static_cast<unsigned>(static_cast<unsigned char>(bytes_[at + 1])) << kByte |
         static_cast<unsigned char>(bytes_[at]);
}

std::uint32_t VelodynePacket::time() const {
  return wordAt(kTimeAt) | wordAt(kTimeAt + 2) << (2 * kByte);
}

std::uint8_t VelodynePacket::product() const {
  return static_cast<std::uint8_t>(bytes_[kProductAt]);
}

bool VelodynePacket::isDual() const {
  return static_cast<unsigned char>(bytes_[kReturnAt]) == kDualReturn;
}

unsigned VelodynePacket::azimuth(std::size_t block) const { return wordAt(block * kBlockSize + 2); }

unsigned VelodynePacket::azimuthStep(std::size_t block) const {
  const std::size_t next = isDual() ? 2 : 1;
  // For the last one, the angle of the one before it is used.
  const std::size_t from = block + next < kBlocks ? block : block - next;
  const unsigned step = (azimuth(from + next) + kFullTurn - azimuth(from)) % kFullTurn;
  return step <= kFullTurn / 2 ? step : 0;
}

unsigned VelodynePacket::distance(std::size_t block, std::size_t channel) const {
  return wordAt(block * kBlockSize + kBlockHead + channel * kChannelSize);
}

std::uint8_t VelodynePacket::intensity(std::size_t block, std::size_t channel) const {
  return static_cast<std::uint8_t>(
      bytes_[block * kBlockSize + kBlockHead + channel * kChannelSize + 2]);
}

double blockOffset(const VelodyneModel& model, bool is_dual, std::size_t block) {
  return model.blockTime() * static_cast<double>(is_dual ? block / 2 : block);
}

double packetSpan(const VelodyneModel& model, bool is_dual) {
  return blockOffset(model, is_dual, VelodynePacket::kBlocks) - model.sequence_time +
         static_cast<double>(model.lasers.back().time);
}

void appendPoints(const VelodynePacket& packet, std::size_t block, const VelodyneModel& model,
                  const RangeLimits& limits, double time, std::vector<CloudPoint>& points) {
  const auto min_range = static_cast<float>(limits.min);
  const auto max_range = static_cast<float>(limits.max);
  const double azimuth = degrees(packet.azimuth(block) * kAzimuthUnit);
  const auto cosine = static_cast<float>(std::cos(azimuth));
  const auto sine = static_cast<float>(std::sin(azimuth));
  const double turning =
      degrees(packet.azimuthStep(block) * kAzimuthUnit) / model.blockTime();  // rad/s
  const bool is_second = packet.isDual() && block % 2 == 1;
  const std::size_t lasers = model.lasers.size();
  for (std::size_t channel = 0; channel < VelodyneModel::kChannels; ++channel) {
    const unsigned distance = packet.distance(block, channel);
    const float range = static_cast<float>(distance) * model.distance_unit;
    if (range < min_range || range > max_range || distance == 0 ||
        (is_second && distance == packet.distance(block - 1, channel))) {
      continue;
    }
    const std::size_t sequence = channel / lasers;
    const VelodyneLaser& laser = model.lasers[channel % lasers];
    const double offset =
        model.sequence_time * static_cast<double>(sequence) + static_cast<double>(laser.time);
    // A block turns by less than half a degree: the second-order error is 1e-7.
    const auto angle = static_cast<float>(turning * offset);
    const float cos_angle = 1.0F - 0.5F * angle * angle;
    const float cos_turned = laser.cos_offset * cos_angle - laser.sin_offset * angle;
    const float sin_turned = laser.sin_offset * cos_angle + laser.cos_offset * angle;
    const float horizontal = range * laser.cos_elevation;
    points.push_back({horizontal * (cosine * cos_turned - sine * sin_turned),
                      -horizontal * (sine * cos_turned + cosine * sin_turned),
                      range * laser.sin_elevation + laser.height,
                      static_cast<float>(packet.intensity(block, channel)),
                      static_cast<float>(time + offset), laser.ring});
  }
}

}  // namespace datmo
