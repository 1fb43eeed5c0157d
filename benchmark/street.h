// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "datmo_fusion/common/scan.h"
#include "datmo_fusion/slam/odometry_buffer.h"

namespace datmo {

/// The benchmarks' simulated scene: an endless straight street with parked cars (4.5 m long, gaps
/// of 1.5 m) in front of houses on both sides, with seeded noise.
struct StreetOptions {
  int beams = 81;      ///< over 160 degrees
  double speed = 8.0;  ///< m/s; 0: standing
};

/// The drive as an endless sequence of scans: the street repeats itself, and so do the scans,
/// except for their stamps.
class StreetDrive {
 public:
  explicit StreetDrive(const StreetOptions& options);

  /// Advances to the next scan, which is valid until the next call.
  const Scan& next();

  /// Exact odometry at the stamp of that scan.
  OdometrySample odometry() const;

 private:
  double speed_;
  std::vector<Scan> scans_;
  std::size_t step_ = 0;  ///< of the last scan
};

/// All end points of a scan, each with this state in the map.
LabeledScan labeledScan(const Scan& scan, PointState state);

}  // namespace datmo
