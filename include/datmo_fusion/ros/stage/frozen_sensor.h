// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include <sensor_msgs/LaserScan.h>
#include <sensor_msgs/MultiEchoLaserScan.h>

#include "datmo_fusion/common/pose2.h"
#include "datmo_fusion/common/stamp.h"
#include "datmo_fusion/ros/stage/stage_monitor.h"

namespace datmo {

/// Returns the vehicle's motion from one stamp to a later one; none if unknown.
using MotionBetween = std::function<std::optional<Pose2>(Stamp from, Stamp to)>;

/// Detects a sensor whose driver repeats its last measurement with new stamps: bit for bit
/// identical, which noise makes impossible, although the vehicle has moved. There is no verdict
/// while it stands or its motion is unknown: a measurement without noise may then stay the same.
class FrozenSensor {
 public:
  /// Stamps must rise. `measured`: empty if it may repeat for other reasons (nothing in view).
  bool update(Stamp stamp, std::vector<std::uint8_t> measured, const MotionBetween& motion);

  void reset() { *this = FrozenSensor(); }

 private:
  std::vector<std::uint8_t> last_;
  Stamp last_stamp_;
  Pose2 moved_;  ///< since the first measurement with these bytes
  bool is_frozen_ = false;
};

/// Throws InputError (`frozen_scan`) if a scan is from a frozen scanner; until another one comes
/// the stage has no output.
void checkNotFrozen(bool is_frozen, StageMonitor& monitor);

/// Returns the bytes of a scan's ranges; empty if it has too few echoes to distinguish it from
/// another.
std::vector<std::uint8_t> measuredBytes(const sensor_msgs::LaserScan& scan);
std::vector<std::uint8_t> measuredBytes(const sensor_msgs::MultiEchoLaserScan& scan);

}  // namespace datmo
