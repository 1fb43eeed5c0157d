// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/common/scan.h"

namespace datmo {

/// The scanner that several are merged into.
struct ScanMergerOptions {
  double beam_spacing = 0.0087266;  ///< rad
  double max_range = 80.0;          ///< m
  double surface_gap = 0.5;         ///< m

  void visit(OptionVisitor& visitor);
};

/// The scan without the beams that look into sectors (rad about the scanner, from its x axis to the
/// left): pairs of where one begins and where it ends, to the left. They are blind then.
Scan withoutSectors(Scan scan, const std::vector<double>& sectors);

/// Scans of one time -> the ranges that one scanner at the vehicle's origin would have measured,
/// all around. Of several end points in one beam the nearest counts. Two neighboring beams of a
/// scanner that hit one surface, or that both hit nothing, hold for all beams between their end
/// points; what lies between a near and a far end point was seen by nobody.
class ScanMerger {
 public:
  /// Throws OptionError.
  explicit ScanMerger(const Checked<ScanMergerOptions>& options);

  /// m, by rising bearing from -pi; +inf: free as far as a beam without return is known to be; NaN:
  /// no scanner has measured there. `scans`: in the vehicle's frame at one time.
  std::vector<float> ranges(const std::vector<Scan>& scans) const;

  /// rad, from a beam to the next one: a whole turn has a whole number of them.
  double beamSpacing() const;

 private:
  std::size_t beamAt(const Point2& point) const;
  void addEnd(const Ray& ray, std::vector<float>& ranges) const;
  void fillBetween(const Ray& ray, const Ray& next, std::vector<float>& ranges) const;

  ScanMergerOptions options_;
  std::size_t beams_;
};

}  // namespace datmo
