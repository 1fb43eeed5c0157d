// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "datmo_fusion/device/device_data.h"
#include "datmo_fusion/device/velodyne_model.h"

namespace datmo {

/// A data packet of Velodyne's lidars (VLP-16 User Manual, 63-9243 Rev. E, 9.3): 12 blocks of 32
/// measurements, a time, the return mode and the product.
class VelodynePacket {
 public:
  static constexpr std::size_t kSize = 1206;
  static constexpr std::size_t kBlocks = 12;
  static constexpr unsigned kFullTurn = 36000;  ///< hundredths of a degree

  /// `bytes` must outlive it. Throws DeviceError: `bad_packet` for another length or without
  /// blocks, `wrong_device` for a lidar with two kinds of blocks (HDL-64E).
  explicit VelodynePacket(std::string_view bytes);

  std::uint32_t time() const;    ///< us past the hour
  std::uint8_t product() const;  ///< not with old firmware (VLP-16: before 3.0.29)
  bool isDual() const;           ///< two blocks of each firing

  /// Returns the azimuth of a block's first firing, hundredths of a degree, clockwise from straight
  /// ahead.
  unsigned azimuth(std::size_t block) const;

  /// Returns the angle from a block's first firing to that of the next one, at most half a turn.
  unsigned azimuthStep(std::size_t block) const;

  /// Returns the distance in the model's unit; 0: no return.
  unsigned distance(std::size_t block, std::size_t channel) const;
  std::uint8_t intensity(std::size_t block, std::size_t channel) const;

 private:
  unsigned wordAt(std::size_t at) const;

  std::string_view bytes_;
};

/// Returns when a packet's block was measured, s after the packet's first firing.
double blockOffset(const VelodyneModel& model, bool is_dual, std::size_t block);

/// Returns the time from the first firing of a packet to the last, s.
double packetSpan(const VelodyneModel& model, bool is_dual);

/// Nearer or farther returns (m) are ignored.
struct RangeLimits {
  double min = 0.4;
  double max = 130.0;
};

/// Appends the points of a block, in the lidar's frame (REP 103), with times from `time` (s) on.
/// The azimuth of each firing is interpolated to that of the next block, and the offset of each
/// laser is added. Of two equal returns, one is used.
void appendPoints(const VelodynePacket& packet, std::size_t block, const VelodyneModel& model,
                  const RangeLimits& limits, double time, std::vector<CloudPoint>& points);

}  // namespace datmo
