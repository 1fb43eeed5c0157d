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

/// Beams of one scan, by what became of them.
struct BeamCounts {
  std::size_t hits = 0;
  std::size_t no_return = 0;  ///< +inf or beyond range_max (REP 117), or beyond 1 km
  std::size_t dropped = 0;    ///< NaN, -inf, 0, negative or below range_min: no ray
};

/// A message as a scan, and what of it could not be used.
struct ConvertedScan {
  Scan scan;
  BeamCounts beams;
  /// `bad_beam_times`: why all beams are taken as measured at the stamp.
  std::optional<InputError> unusable_times;
};

/// A scan, brought to the vehicle's frame at each beam's own time: `time_increment` after that of
/// the beam before it, the first one's at the header's stamp. A beam without return is free up to
/// `free_range` or range_max, whichever is nearer.
///
/// A time increment that is not finite, negative or makes the sweep longer than `max_sweep`
/// does not cost the scan.
///
/// Throws InputError: `empty_scan` (no beams), `bad_geometry` (angles or range limits that are not
/// finite, no angle increment, limits the wrong way round), `wrong_size` (more than one beam more
/// or less than the angles say; drivers disagree whether angle_max is the last beam or one beyond;
/// or more than 65536).
ConvertedScan toScan(const sensor_msgs::LaserScan& message, const ScannerMount& mount,
                     const ScanConversionOptions& options);

/// The same for several echoes a beam: the nearest valid one counts.
ConvertedScan toScan(const sensor_msgs::MultiEchoLaserScan& message, const ScannerMount& mount,
                     const ScanConversionOptions& options);

/// What a scan is used in spite of: `bad_beam_times`, `tilted_scanner` where the scan plane is
/// tilted by more than `max_tilt` (rad), `no_valid_beam`. `without_beams`: what follows from the
/// last one.
std::vector<InputError> faultsOf(const ScannerMount& mount, const ConvertedScan& converted,
                                 double max_tilt, const std::string& without_beams);

}  // namespace datmo
