// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>

#include "datmo_fusion/device/device_error.h"

namespace datmo::samples {

/// Returns the reason of its failure; "none" if it does not fail.
inline std::string reasonOf(const std::function<void()>& act) {
  try {
    act();
  } catch (const DeviceError& error) {
    return error.reason();
  }
  return "none";
}

}  // namespace datmo::samples
