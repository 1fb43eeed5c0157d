// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/device/device.h"
#include "datmo_fusion/device/packet_source.h"
#include "datmo_fusion/device/velodyne_packet.h"

namespace datmo {

struct VelodyneOptions {
  std::string model = "auto";  ///< name of a VelodyneModel, or auto: as reported in the packets
  double min_range = 0.4;      ///< m
  double max_range = 130.0;    ///< m
  double seam = 3.14159;       ///< rad

  void visit(OptionVisitor& visitor);
};

/// Throws DeviceError.
using PacketOpener = std::function<std::unique_ptr<PacketSource>()>;

/// A rotating Velodyne lidar (VLP-16, Puck LITE, Puck Hi-Res, VLP-32C, HDL-32E): one cloud per
/// turn, with one or two returns. The first turn, which is incomplete, is dropped.
///
/// The stamp of a cloud is that of its first firing. Packets carry the lidar's time, and arrive
/// when their last firing is done.
class VelodyneLidar : public Device {
 public:
  static constexpr int kPort = 2368;

  /// `open`: opens the source of its packets.
  VelodyneLidar(PacketOpener open, VelodyneOptions options, const DeviceHost& host);

  std::string connect() override;
  DeviceMeasurement next() override;

 private:
  /// A cloud that is not complete yet.
  struct Turn {
    Stamp stamp;
    DeviceCloud cloud;
  };

  /// Returns the next valid packet. Invalid ones are counted; many in a row are an error: there is
  /// no lidar.
  VelodynePacket nextPacket();
  const VelodyneModel& modelOf(const VelodynePacket& packet) const;
  /// Returns whether a packet may come from this model.
  bool isOf(const VelodyneModel& model, const VelodynePacket& packet) const;
  /// Returns whether a packet is older than the last one, or a duplicate; warns if so.
  bool isLate(const VelodynePacket& packet) const;
  void readTime(const VelodynePacket& packet);
  /// Processes the blocks of the packet up to the end of a turn, or of the packet.
  std::optional<DeviceMeasurement> readBlocks();
  std::optional<DeviceMeasurement> endTurn(std::size_t block);

  PacketOpener open_;
  VelodyneOptions options_;
  DeviceHost host_;
  std::unique_ptr<PacketSource> source_;
  const VelodyneModel* model_ = nullptr;
  std::optional<VelodynePacket> packet_;  ///< currently processed
  std::size_t next_block_ = 0;            ///< of it
  Stamp packet_stamp_;                    ///< of its first firing
  unsigned seam_ = 0;                     ///< hundredths of a degree, clockwise from straight ahead
  unsigned last_angle_ = 0;               ///< the same from the seam, of the last block
  std::optional<Turn> turn_;              ///< none before the first seam
  double age_ = 0.0;                      ///< s, from the seam to the packet's first firing
  std::size_t last_points_ = 0;           ///< of the last turn
  std::uint64_t missed_ = 0;              ///< packets, since the last cloud
};

}  // namespace datmo
