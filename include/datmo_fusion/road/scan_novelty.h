// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/common/pose2.h"

namespace datmo {

struct ScanNoveltyOptions {
  double correlation_length = 0.3;  ///< m
  double correlation_time = 10.0;   ///< s

  void visit(OptionVisitor& visitor);
};

/// Share of new information in a scan. From one viewpoint the same beams hit the same surfaces, so
/// a waiting vehicle learns almost nothing from scan to scan. The errors of two scans correlate by
/// exp(-distance / length - time / correlation time), a Gauss-Markov process in both, whose
/// innovation has the share 1 - correlation^2 of the variance (Bar-Shalom, Li, Kirubarajan 2001,
/// 8.2: autocorrelated noise).
class ScanNovelty {
 public:
  explicit ScanNovelty(const ScanNoveltyOptions& options) : options_(options) {}

  /// Returns the share of the next scan, 0 to 1; 1 for the first. `scanner`: its position, map
  /// frame; `seconds` >= 0 since the last scan.
  double update(const Point2& scanner, double seconds);

  /// Forgets the last scan.
  void reset() { last_.reset(); }

 private:
  ScanNoveltyOptions options_;
  std::optional<Point2> last_;
};

}  // namespace datmo
