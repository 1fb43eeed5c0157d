// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <variant>
#include <vector>

#include "datmo_fusion/common/stamp.h"

namespace datmo {

/// A scan of a planar scanner. Bearings are relative to it, in rad, positive to the left; 0 is
/// straight ahead.
struct DeviceScan {
  double first_bearing = 0.0;      ///< rad
  double beam_spacing = 0.0;       ///< rad
  double beam_time = 0.0;          ///< s, from a beam to the next
  double scan_time = 0.0;          ///< s, from a scan to the next
  double min_range = 0.0;          ///< m
  double max_range = 0.0;          ///< m
  std::vector<float> ranges;       ///< m; +inf: no return; NaN: no valid measurement
  std::vector<float> intensities;  ///< in the device's own units; empty: not reported

  /// Returns the time from the first beam to the last, s.
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
  /// Instead of padding, which would be uninitialized: points are published as stored here.
  std::uint16_t unused = 0;
};

/// One turn of a rotating lidar: all points with a return.
struct DeviceCloud {
  std::vector<CloudPoint> points;
};

/// Position of a satellite receiver.
struct SatelliteFix {
  enum class Kind { kNone, kSatellites, kDifferential, kRealTimeKinematic };

  Kind kind = Kind::kNone;
  double latitude = 0.0;        ///< deg, WGS 84; NaN: unknown, also for the next two
  double longitude = 0.0;       ///< deg
  double altitude = 0.0;        ///< m above the ellipsoid
  double sigma = 0.0;           ///< m, along each horizontal axis
  double vertical_sigma = 0.0;  ///< m
  int satellites = 0;
};

/// Velocity of a satellite receiver over the ground.
struct GroundVelocity {
  double speed = 0.0;   ///< m/s, 0 or more
  double course = 0.0;  ///< rad, clockwise from north
};

/// A value with its own stamp.
struct StampedValue {
  double value = 0.0;
  Stamp stamp;
};

/// Motion of the vehicle, as reported on its bus.
struct VehicleTwist {
  double speed = 0.0;              ///< m/s, ahead
  double yaw_rate = 0.0;           ///< rad/s, positive to the left; NaN: unknown
  std::uint64_t other_frames = 0;  ///< on the bus so far that are not used
  /// rad, of the front wheels, positive to the left; none: no new one since the last motion.
  std::optional<StampedValue> steering;
  std::optional<StampedValue> acceleration;  ///< m/s^2, ahead; none: the same
};

using DeviceData =
    std::variant<DeviceScan, DeviceCloud, SatelliteFix, GroundVelocity, VehicleTwist>;

/// A measurement of a device, stamped on the computer's clock.
struct DeviceMeasurement {
  Stamp stamp;  ///< of the first beam or firing
  DeviceData data;
  std::uint64_t missed = 0;  ///< scans, packets or frames between the last one and this
};

}  // namespace datmo
