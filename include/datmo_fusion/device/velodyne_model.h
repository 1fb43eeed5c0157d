// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace datmo {

/// One laser of a rotating lidar, in the order in which they fire.
struct VelodyneLaser {
  float cos_elevation = 1.0F;
  float sin_elevation = 0.0F;
  float cos_offset = 1.0F;  ///< of its azimuth from that of the block, clockwise
  float sin_offset = 0.0F;
  float time = 0.0F;       ///< s, since the first laser of the sequence fired
  float height = 0.0F;     ///< m, of its exit point above the lidar's origin
  std::uint16_t ring = 0;  ///< from the lowest, 0
};

/// Geometry and timing of a Velodyne lidar, from its manual.
struct VelodyneModel {
  std::string name;
  std::uint8_t product = 0;  ///< in its packets
  std::vector<VelodyneLaser> lasers;
  double sequence_time = 0.0;   ///< s, from the first laser to the first one again
  bool stamped_last = false;    ///< a packet's time is that of its last firing, not of its first
  float distance_unit = 2e-3F;  ///< m

  /// Number of sequences of all lasers in one block of a packet.
  std::size_t sequences() const { return kChannels / lasers.size(); }
  double blockTime() const { return sequence_time * static_cast<double>(sequences()); }  ///< s

  static constexpr std::size_t kChannels = 32;  ///< of a block
};

/// Returns all known models.
const std::vector<VelodyneModel>& velodyneModels();

}  // namespace datmo
