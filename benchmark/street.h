// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "datmo_fusion/common/scan.h"
#include "datmo_fusion/slam/odometry_buffer.h"

namespace datmo {

/// Where the benchmarks drive: a straight street without end, with parked cars (4.5 m long, gaps of
/// 1.5 m) in front of houses on both sides. It is made here, of seeded noise alone.
struct StreetOptions {
  int beams = 81;      ///< over 160 degrees
  double speed = 8.0;  ///< m/s; 0: standing
};

/// The drive as an endless sequence of scans: the street repeats itself, and so do the scans, but
/// for their stamps.
class StreetDrive {
 public:
  explicit StreetDrive(const StreetOptions& options);

  /// Goes on to the next scan; it holds until the next call.
  const Scan& next();

  /// Exact odometry at the stamp of that scan.
  OdometrySample odometry() const;

 private:
  double speed_;
  std::vector<Scan> scans_;
  std::size_t step_ = 0;  ///< of the last scan
};

/// All end points of a scan, as if the map had said this of each of them.
LabeledScan labeledScan(const Scan& scan, PointState state);

}  // namespace datmo
