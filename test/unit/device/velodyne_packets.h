// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace datmo::samples {

constexpr std::uint8_t kVlp16 = 0x22;
constexpr std::uint8_t kHdl32e = 0x21;
constexpr std::uint8_t kVlp32c = 0x28;
constexpr std::uint8_t kStrongest = 0x37;
constexpr std::uint8_t kDual = 0x39;

/// A lidar's packet, block by block.
struct VelodyneSample {
  std::uint8_t product = kVlp16;
  std::uint8_t returns = kStrongest;
  std::uint32_t time = 0;  ///< us past the hour
  unsigned azimuth = 0;    ///< hundredths of a degree, of the first block
  unsigned step = 40;      ///< the same, from a firing to the next block's
  std::vector<std::uint16_t> distances{
      5000};  ///< 2 mm (VLP-32C: 4 mm), by channel, again and again
  std::vector<std::uint16_t> second_distances{4000};  ///< of the other blocks of two returns
  std::uint8_t intensity = 77;

  std::string bytes() const;
};

/// The packets of a turning lidar, one after the other.
class VelodyneStream {
 public:
  explicit VelodyneStream(const VelodyneSample& first) : sample_(first) {}

  /// The next packet.
  std::string next();

  /// s, from a packet to the next.
  double period() const;

  /// Number of packets per turn.
  int packetsPerTurn() const;

  /// us past the hour, of the next packet's first firing.
  double time() const { return time_; }
  void setTime(double time) { time_ = time; }

  /// Does not send the next packets.
  void skip(int packets);

 private:
  int firings() const;

  VelodyneSample sample_;
  double time_ = 1e6;
};

}  // namespace datmo::samples
