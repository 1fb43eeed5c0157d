// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/v2x_wire.h"

#include "datmo_fusion/ros/stage/input_error.h"
#include "datmo_fusion/ros/stage/stamp_check.h"

namespace datmo {

namespace {

/// Pause after a look-up of the destination's name has failed, s.
constexpr double kLookUpPause = 10.0;

}  // namespace

V2xWire::V2xWire(const Checked<StationWireOptions>& options, StageMonitor& monitor)
    : options_(*options),
      monitor_(monitor),
      stations_(options, monitor),
      signals_(options->signals, monitor),
      destination_(options->destination, options->destination_port, kLookUpPause) {
  monitor_.condition(HealthLevel::kNoOutput, "not listening yet");
}

void V2xWire::listening() {
  monitor_.condition(HealthLevel::kOk, "listens on UDP port " + std::to_string(options_.port));
}

void V2xWire::failed(const DeviceError& error, Stamp now) {
  monitor_.setTime(now);
  monitor_.dropped(InputError(error.reason(), error.what()));
  monitor_.condition(HealthLevel::kNoOutput, error.what());
}

StationTracksMessagePtr V2xWire::received(std::string_view datagram, Stamp now) {
  const Stopwatch watch;
  checkHasBegun(now);
  if (SignalWire::accepts(datagram)) {
    signals_.received(datagram, now);
    return nullptr;
  }
  StationTracksMessagePtr tracks = stations_.received(datagram, now);
  if (tracks) {
    monitor_.processed({toStamp(tracks->header.stamp), watch.seconds()});
  }
  return tracks;
}

SignalAdviceMessagePtr V2xWire::serveOwn(const StationTracksMessage& tracks) {
  SignalAdviceMessagePtr advice = signals_.advise(tracks);
  send(tracks);
  return advice;
}

void V2xWire::send(const StationTracksMessage& tracks) {
  if (options_.destination.empty()) {
    return;
  }
  try {
    for (const std::string& datagram : stations_.toSend(tracks)) {
      sent_ += destination_.send(datagram) ? 1 : 0;
    }
    monitor_.figure("datagrams sent", static_cast<double>(sent_));
  } catch (const DeviceError& error) {
    monitor_.warned(InputError(error.reason(), error.what()));
  }
}

}  // namespace datmo
