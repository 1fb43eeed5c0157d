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

/// Everything that the nodelet `v2x_wire` does between its topics and its socket: dispatches
/// received datagrams (StationWire, SignalWire), turns our own tracks into advice and datagrams to
/// the destination, and reports both in the diagnostics.
class V2xWire {
 public:
  /// `monitor` must outlive it. Throws OptionError.
  V2xWire(const Checked<StationWireOptions>& options, StageMonitor& monitor);

  /// Reports that the socket is open.
  void listening();

  /// Reports that the socket has failed, at this ROS time.
  void failed(const DeviceError& error, Stamp now);

  /// Returns what a datagram received at this ROS time says about stations; null if nothing. Throws
  /// InputError (`no_ros_time`) if ROS time has not begun.
  StationTracksMessagePtr received(std::string_view datagram, Stamp now);

  /// Sends our own tracks, if there is a destination. Returns advice for the vehicle; null if there
  /// is none.
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
