// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/common/scan.h"

namespace datmo {

/// Where along a beam space is known to be free: nearer to its end than its range is uncertain is
/// what it may have hit.
struct BeamEndOptions {
  double range_sigma = 0.0;  ///< m, of a beam's end; 0: not known
  double end_margin = 3.0;   ///< in range_sigma, 0: a beam frees up to its end

  void visit(OptionVisitor& visitor);

  /// m, before the ray's end, in which it frees nothing; 0 for one without a hit.
  double margin(const Ray& ray) const { return ray.hit ? end_margin * range_sigma : 0.0; }
};

}  // namespace datmo
