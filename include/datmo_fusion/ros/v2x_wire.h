// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "datmo_fusion/device/datagram_sender.h"
#include "datmo_fusion/device/device_error.h"
#include "datmo_fusion/ros/signal_wire.h"
#include "datmo_fusion/ros/stage/stage_monitor.h"
#include "datmo_fusion/ros/station_wire.h"

namespace datmo {

/// All that the nodelet `v2x_wire` does between its topics and its socket: which wire a datagram is
/// for, what our own tracks make (advice, and datagrams to the destination), and what the
/// diagnostics say of both.
class V2xWire {
 public:
  /// `monitor` must outlive it. Throws OptionError.
  V2xWire(const Checked<StationWireOptions>& options, StageMonitor& monitor);

  /// The socket is open.
  void listening();

  /// The socket has failed, at this ROS time.
  void failed(const DeviceError& error, Stamp now);

  /// What a datagram that came at this ROS time says of stations; null if nothing.
  StationTracksMessagePtr received(std::string_view datagram, Stamp now);

  /// Sends our own tracks, if there is a destination. Advice for the vehicle among them; null if
  /// there is none.
  SignalAdviceMessagePtr serveOwn(const StationTracksMessage& tracks);

 private:
  void send(const StationTracksMessage& tracks);

  StationWireOptions options_;
  StageMonitor& monitor_;
  StationWire stations_;
  SignalWire signals_;
  DatagramDestination destination_;
  std::uint64_t sent_ = 0;
};

}  // namespace datmo
