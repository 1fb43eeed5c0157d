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

/// The vehicle's motion from one stamp to a later one; none if it is not known.
using MotionBetween = std::function<std::optional<Pose2>(Stamp from, Stamp to)>;

/// Knows a sensor whose driver repeats its last measurement under new stamps: bit for bit the same,
/// which noise does not allow, though the vehicle has moved. While it stands, and where its motion
/// is not known, nothing is said: a picture without noise may stay the same then.
class FrozenSensor {
 public:
  /// By rising stamp. `measured`: empty if it is the same for many reasons (nothing is in view).
  bool take(Stamp stamp, std::vector<std::uint8_t> measured, const MotionBetween& motion);

  void reset() { *this = FrozenSensor(); }

 private:
  std::vector<std::uint8_t> last_;
  Stamp last_stamp_;
  Pose2 moved_;  ///< since the first measurement with these bytes
  bool is_frozen_ = false;
};

/// Throws InputError (`frozen_scan`) if a scan is of a frozen scanner, and until there is another
/// one the stage makes nothing.
void checkNotFrozen(bool is_frozen, StageMonitor& monitor);

/// The bytes of a scan's ranges; empty if too few beams come back to tell it from another.
std::vector<std::uint8_t> measuredBytes(const sensor_msgs::LaserScan& scan);
std::vector<std::uint8_t> measuredBytes(const sensor_msgs::MultiEchoLaserScan& scan);

}  // namespace datmo
