// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/common/scan.h"

namespace datmo {

/// The part of a beam along which space is known to be free: within a margin before its end, given
/// by the range uncertainty, it may already be inside the object that it hit.
struct BeamEndOptions {
  double range_sigma = 0.0;  ///< m, range noise (standard deviation); 0: unknown
  double end_margin = 3.0;   ///< in range_sigma; 0: a beam frees cells up to its end

  void visit(OptionVisitor& visitor);

  /// Returns how far before its end a ray frees nothing, m; 0 for a ray without a hit.
  double margin(const Ray& ray) const { return ray.hit ? end_margin * range_sigma : 0.0; }
};

}  // namespace datmo
