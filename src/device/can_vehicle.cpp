// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/device/can_vehicle.h"

#include <array>
#include <utility>

#include <linux/can/error.h>

namespace datmo {

namespace {

constexpr int kMaxBadFrames = 20;  ///< in a row: it is not a bus

/// Returns the classes of an error frame in readable form.
std::string errorText(std::uint32_t error) {
  constexpr std::array<std::pair<std::uint32_t, const char*>, 9> kClasses = {
      {{CAN_ERR_TX_TIMEOUT, "timeout of sending"},
       {CAN_ERR_LOSTARB, "lost arbitration"},
       {CAN_ERR_CRTL, "controller: overflow, warning level or passive"},
       {CAN_ERR_PROT, "violation of the protocol"},
       {CAN_ERR_TRX, "transceiver"},
       {CAN_ERR_ACK, "no acknowledgement"},
       {CAN_ERR_BUSOFF, "bus off"},
       {CAN_ERR_BUSERROR, "bus error"},
       {CAN_ERR_RESTARTED, "restarted"}}};
  std::string text;
  for (const auto& [bit, name] : kClasses) {
    if ((error & bit) != 0) {
      text += (text.empty() ? "" : ", ") + std::string(name);
    }
  }
  return text.empty() ? "without a class" : text;
}

}  // namespace

CanVehicle::CanVehicle(CanOpener open, const Checked<CanOptions>& options, std::string name,
                       std::optional<double> timeout, const DeviceHost& host)
    : open_(std::move(open)),
      delay_(options->delay),
      name_(std::move(name)),
      timeout_(timeout),
      host_(host),
      motion_(options, host.warn) {}

std::string CanVehicle::connect() {
  source_ = open_();
  last_motion_ = Clock::now();
  try {
    pending_ = nextMotion();
  } catch (const RecordingEnd& end) {
    throw RecordingEnd(std::string(end.what()) + ", and gave no motion from its " +
                       std::to_string(frames_) + " frames: expected some with " +
                       motion_.paceText());
  }
  return "the CAN bus of " + name_;
}

DeviceMeasurement CanVehicle::next() {
  return pending_ ? *std::exchange(pending_, std::nullopt) : nextMotion();
}

DeviceMeasurement CanVehicle::nextMotion() {
  while (true) {
    const CanFrame frame = nextFrame();
    if (frame.lost > 0) {
      host_.warn({"frames_lost", std::to_string(frame.lost) + " frames of " + name_ +
                                     " were lost: is this computer too busy?"});
    }
    if (frame.error) {
      handleError(*frame.error);
    } else {
      ++frames_;
      const Stamp stamp = host_.clock.now() + -(frame.age + delay_);
      if (const std::optional<CanMotion::Motion> motion = motion_.update(frame, stamp)) {
        last_motion_ = Clock::now();
        return {stamp, motion->twist, motion->missed};
      }
    }
    if (timeout_ &&
        std::chrono::duration<double>(Clock::now() - last_motion_).count() > *timeout_) {
      throw DeviceError("silent_device",
                        "no motion from " + name_ + " for " + std::to_string(*timeout_) +
                            " s, of " + std::to_string(frames_) + " frames since it was opened, " +
                            std::to_string(motion_.otherFrames()) +
                            " of them without our signals: expected " + motion_.paceText() +
                            " and the other signals of can, valid");
    }
  }
}

CanFrame CanVehicle::nextFrame() {
  for (int bad = 1;; ++bad) {
    try {
      return source_->next();
    } catch (const CanFrameError& error) {
      if (bad > kMaxBadFrames) {
        if (!timeout_) {
          throw RecordingEnd(std::string(error.what()) + "; it is the last of " +
                             std::to_string(bad) + " such lines in a row: playback stops");
        }
        throw;
      }
      host_.warn(error);
    }
  }
}

void CanVehicle::handleError(std::uint32_t error) const {
  const std::string text = name_ + " reports an error (" + errorText(error) +
                           "): expected none; check the bit rate, the termination and the cable";
  if ((error & CAN_ERR_BUSOFF) != 0) {
    const DeviceError off("bus_off", text);
    if (timeout_) {
      throw off;
    }
    host_.warn(off);
    return;
  }
  host_.warn({"bus_error", text});
}

}  // namespace datmo
