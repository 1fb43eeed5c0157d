// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include <linux/can.h>

#include "datmo_fusion/device/can_frame.h"

namespace datmo {

/// Sets id and kind of a frame from the system's number, with flags in the upper bits
/// (CAN_EFF_FLAG, CAN_ERR_FLAG).
inline void setNumber(std::uint32_t number, bool is_extended, CanFrame& frame) {
  if ((number & CAN_ERR_FLAG) != 0) {
    frame.error = number & CAN_ERR_MASK;
  } else {
    frame.id = {number & (is_extended ? CAN_EFF_MASK : CAN_SFF_MASK), is_extended};
  }
}

}  // namespace datmo
