// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/common/scan.h"

namespace datmo {

/// The scanner into which several are merged.
struct ScanMergerOptions {
  double beam_spacing = 0.0087266;  ///< rad
  double max_range = 80.0;          ///< m
  double surface_gap = 0.5;         ///< m

  void visit(OptionVisitor& visitor);
};

/// Returns the scan without the beams in these sectors (rad about the scanner, from its x axis to
/// the left): pairs of begin and end, counterclockwise. These beams become blind.
Scan withoutSectors(Scan scan, const std::vector<double>& sectors);

/// Merges scans of one time into the ranges that one scanner at the vehicle's origin would have
/// measured, all around. Of several end points in one beam the nearest counts. If two neighboring
/// beams of a scanner hit one surface, or both hit nothing, this applies to all beams between their
/// end points; what lies between a near and a far end point was not seen.
class ScanMerger {
 public:
  /// Throws OptionError.
  explicit ScanMerger(const Checked<ScanMergerOptions>& options);

  /// Returns ranges, m, by ascending bearing from -pi; +inf: free as far as a beam without return
  /// is known to be; NaN: no scanner measured there. `scans`: in the vehicle's frame at one time.
  std::vector<float> ranges(const std::vector<Scan>& scans) const;

  /// Returns the beam spacing, rad: a full turn has an integer number of beams.
  double beamSpacing() const;

 private:
  std::size_t beamAt(const Point2& point) const;
  void addEnd(const Ray& ray, std::vector<float>& ranges) const;
  void fillBetween(const Ray& ray, const Ray& next, std::vector<float>& ranges) const;

  ScanMergerOptions options_;
  std::size_t beams_;
};

}  // namespace datmo
