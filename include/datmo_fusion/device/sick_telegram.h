// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "datmo_fusion/device/cola.h"
#include "datmo_fusion/device/device_data.h"

namespace datmo {

/// A supported scanner.
struct SickModel {
  std::string name;
  double max_range = 0.0;  ///< m
};

/// Returns the model in an answer to `sRN DeviceIdent`. Throws DeviceError: `wrong_device` for a
/// scanner whose range and bearings are not known here, `bad_answer` for an incomplete answer.
SickModel sickModel(const ColaTelegram& answer);

/// What a scanner reports about itself.
enum class SickState { kGood, kFault, kDirty };

struct SickScan {
  SickState state = SickState::kGood;
  std::uint16_t counter = 0;  ///< of all scans
  std::uint32_t begun = 0;    ///< us since the scanner was switched on, when the scan began
  std::uint32_t sent = 0;     ///< the same, when it was sent
  DeviceScan scan;
};

/// Decodes a scan (`sSN LMDscandata`): the first echoes (DIST1), and their remission (RSSI1) if
/// present. No echo is +inf; error codes, and ranges below them, are NaN. Throws DeviceError
/// (`bad_answer`) for a telegram that is incomplete, or has no such channel.
SickScan sickScan(const ColaTelegram& telegram, const SickModel& model);

/// Returns whether an answer to `sRN STlms` reports a scanner that will measure without a command;
/// false for one that was stopped. Throws DeviceError (`bad_answer`).
bool isSickWarmingUp(const ColaTelegram& answer);

}  // namespace datmo
