// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/sensor_model/cloud_ground.h"
#include "datmo_fusion/sensor_model/lidar_points.h"
#include "datmo_fusion/sensor_model/sweep_timing.h"

namespace datmo {

/// The planar scanner that a cloud is converted to.
struct CloudToScanOptions {
  double min_height = 0.3;          ///< m above the ground
  double max_height = 0.9;          ///< m above the ground
  double min_range = 1.0;           ///< m
  double max_range = 50.0;          ///< m
  double beam_spacing = 0.0087266;  ///< rad
  double beam_width = 0.0;          ///< rad; 0: beam_spacing
  double field_of_view = 6.28319;   ///< rad
  double blind_width = 0.0349066;   ///< rad
  OwnVehicleOptions vehicle;
  CloudGroundOptions ground;
  SweepOptions sweep;

  void visit(OptionVisitor& visitor);
  void check() const;
};

/// A planar scan about the lidar, as seen from above, in the axes of base_link.
struct PlanarScan {
  double first_bearing = 0.0;  ///< rad, of beam 0
  double beam_spacing = 0.0;   ///< rad, from one beam to the next; negative: clockwise
  double first_time = 0.0;     ///< s after the cloud's stamp, of beam 0
  double beam_time = 0.0;      ///< s, from one beam to the next; 0: all at once
  std::vector<float>
      ranges;          ///< m; +inf: no obstacle in the band; NaN: the lidar sees nothing there
  CloudGround ground;  ///< reference of heights
  std::size_t own_points = 0;   ///< on the vehicle itself
  std::size_t band_points = 0;  ///< in the height band and within range
  std::size_t blind_beams = 0;  ///< beams that are NaN
  /// The sweep ends within the field of view, so that the times of the beams do not ascend: they
  /// are taken as simultaneous.
  bool sweep_ends_inside = false;
};

/// Converts a cloud of a 3D lidar to the planar scan of obstacles in a height band above the
/// ground: the nearest point of each beam. This is an emulation: the lidar looks down, and so sees
/// over low obstacles that would block a scanner at the bumper.
///
/// The same cloud gives the same scan.
class CloudToScan {
 public:
  /// Throws OptionError.
  explicit CloudToScan(const Checked<CloudToScanOptions>& options);

  /// Returns the scan; an empty cloud gives a scan of blind beams.
  PlanarScan scan(const LidarCloud& cloud) const;

  /// Returns the height of the emulated scanner above the ground, m: the middle of the band.
  double height() const { return 0.5 * (options_.min_height + options_.max_height); }

 private:
  CloudToScanOptions options_;
};

}  // namespace datmo
