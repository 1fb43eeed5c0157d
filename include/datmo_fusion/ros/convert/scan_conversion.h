// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <sensor_msgs/LaserScan.h>
#include <sensor_msgs/MultiEchoLaserScan.h>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/common/scan.h"
#include "datmo_fusion/ros/frames.h"
#include "datmo_fusion/ros/stage/input_error.h"

namespace datmo {

struct ScanConversionOptions {
  double free_range = 40.0;  ///< m
  double max_sweep = 0.25;   ///< s

  void visit(OptionVisitor& visitor);
};

/// Numbers of unusable beams of one scan, by reason.
struct BeamCounts {
  std::size_t hits = 0;
  std::size_t no_return = 0;  ///< +inf, or range_max or more (REP 117), or 1 km or more
  std::size_t dropped = 0;    ///< NaN, -inf, 0, negative or below range_min: no ray
};

/// A converted scan, and what of it could not be used.
struct ConvertedScan {
  Scan scan;
  BeamCounts beams;
  /// `bad_beam_times`: why all beams are assumed to be measured at the stamp.
  std::optional<InputError> unusable_times;
};

/// Converts a scan to the vehicle's frame at each beam's own time: the first at the header's stamp,
/// each later one `time_increment` after the beam before it. A beam without return is free up to
/// `free_range` or range_max, whichever is nearer.
///
/// A time increment that is not finite, negative or makes the sweep longer than `max_sweep` is
/// ignored; the scan is still used.
///
/// Throws InputError: `empty_scan` (no beams), `bad_geometry` (non-finite angles or range limits,
/// angle increment 0, or range limits in the wrong order), `wrong_size` (the number of beams
/// differs by more than one from that of the angles, since drivers disagree whether angle_max is
/// the last beam or one beyond; or is more than 65536).
ConvertedScan toScan(const sensor_msgs::LaserScan& message, const ScannerMount& mount,
                     const ScanConversionOptions& options);

/// The same for several echoes per beam: the nearest valid one is used.
ConvertedScan toScan(const sensor_msgs::MultiEchoLaserScan& message, const ScannerMount& mount,
                     const ScanConversionOptions& options);

/// Returns faults in spite of which a scan is used: `bad_beam_times`, `tilted_scanner` if the scan
/// plane is tilted by more than `max_tilt` (rad), `no_valid_beam`. `without_beams`: consequence of
/// the last one.
std::vector<InputError> faultsOf(const ScannerMount& mount, const ConvertedScan& converted,
                                 double max_tilt, const std::string& without_beams);

}  // namespace datmo
