// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/fusion/wire/station_messages.h"
#include "datmo_fusion/ros/convert/earth_conversion.h"
#include "datmo_fusion/ros/signal_wire.h"
#include "datmo_fusion/ros/stage/stage_monitor.h"

namespace datmo {

/// Options of the nodelet `v2x_wire`.
struct StationWireOptions {
  int port = 37001;
  std::string source;
  std::string destination;
  int destination_port = 37001;
  double interval = 0.1;  ///< s
  StationMessageOptions messages;
  SignalWireOptions signals;

  void visit(OptionVisitor& visitor);
};

/// Converts between StationTracks messages and datagrams: CAM and CPM. Counts received and, by
/// reason, unusable messages. Messages of other kinds and echoes of our own are not faults; a
/// message of another station with our number is.
class StationWire {
 public:
  /// `monitor` must outlive it. Throws OptionError.
  StationWire(const Checked<StationWireOptions>& options, StageMonitor& monitor);

  /// Returns the content of a datagram; null if there is none. `now`: ROS time of its arrival.
  StationTracksMessagePtr received(std::string_view bytes, Stamp now);

  /// Returns the datagrams that send our tracks to others; none if that would on average be more
  /// often than `interval` allows.
  std::vector<std::string> toSend(const StationTracksMessage& message);

 private:
  bool isDue(Stamp stamp);

  StationWireOptions options_;
  StageMonitor& monitor_;
  std::optional<std::uint32_t> own_station_;  ///< our station number, as sent
  std::deque<std::string> recent_;            ///< datagrams sent
  std::optional<Stamp> due_;                  ///< time of the next list
  std::optional<Stamp> last_low_frequency_;
  std::uint64_t others_ = 0;    ///< messages of other kinds
  std::uint64_t own_ = 0;       ///< echoes of our own messages
  std::uint64_t left_out_ = 0;  ///< objects without id or position
};

}  // namespace datmo
