// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <variant>
#include <vector>

#include "datmo_fusion/common/stamp.h"

namespace datmo {

/// A scan of a planar scanner. Bearings are about it, in rad, positive to the left; 0 is straight
/// ahead.
struct DeviceScan {
  double first_bearing = 0.0;      ///< rad
  double beam_spacing = 0.0;       ///< rad
  double beam_time = 0.0;          ///< s, from a beam to the next
  double scan_time = 0.0;          ///< s, from a scan to the next
  double min_range = 0.0;          ///< m
  double max_range = 0.0;          ///< m
  std::vector<float> ranges;       ///< m; +inf: no return; NaN: no valid measurement
  std::vector<float> intensities;  ///< in units of the device's own; empty: it tells none

  /// s, from the first beam to the last.
  double sweep() const {
    return ranges.empty() ? 0.0 : beam_time * static_cast<double>(ranges.size() - 1);
  }
};

/// A point of a rotating lidar, in its frame (REP 103).
struct CloudPoint {
  float x = 0.0F;          ///< m
  float y = 0.0F;          ///< m
  float z = 0.0F;          ///< m
  float intensity = 0.0F;  ///< 0 to 255
  float time = 0.0F;       ///< s after the stamp
  std::uint16_t ring = 0;  ///< from the lowest laser, 0
  /// In place of padding, which would be left to chance: points are published as they are here.
  std::uint16_t unused = 0;
};

/// One turn of a rotating lidar: what had a return.
struct DeviceCloud {
  std::vector<CloudPoint> points;
};

/// Where a satellite receiver is.
struct SatelliteFix {
  enum class Kind { kNone, kSatellites, kDifferential, kRealTimeKinematic };

  Kind kind = Kind::kNone;
  double latitude = 0.0;        ///< deg, WGS 84; NaN: not known, as the next two
  double longitude = 0.0;       ///< deg
  double altitude = 0.0;        ///< m above the ellipsoid
  double sigma = 0.0;           ///< m, along each horizontal axis
  double vertical_sigma = 0.0;  ///< m
  int satellites = 0;
};

/// How a satellite receiver moves over the ground.
struct GroundVelocity {
  double speed = 0.0;   ///< m/s, 0 or more
  double course = 0.0;  ///< rad, clockwise from north
};

/// How the vehicle moves, as its own bus says.
struct VehicleTwist {
  double speed = 0.0;              ///< m/s, ahead
  double yaw_rate = 0.0;           ///< rad/s, positive to the left; NaN: not known
  std::uint64_t other_frames = 0;  ///< of the bus, so far, without anything of it
};

using DeviceData =
    std::variant<DeviceScan, DeviceCloud, SatelliteFix, GroundVelocity, VehicleTwist>;

/// What a device has measured, on the computer's clock.
struct DeviceMeasurement {
  Stamp stamp;  ///< of the first beam or firing
  DeviceData data;
  std::uint64_t missed = 0;  ///< scans, packets or frames between the last one and this
};

}  // namespace datmo
