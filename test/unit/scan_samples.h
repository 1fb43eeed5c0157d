// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "datmo_fusion/common/scan.h"

namespace datmo::samples {

/// A scan of these rays; `beam_spacing`: rad, 0 for beams without an opening angle.
inline Scan scanWithRays(const std::vector<Ray>& rays, double beam_spacing = 0.0) {
  Scan scan;
  scan.field.beam_spacing = beam_spacing;
  scan.rays = rays;
  return scan;
}

}  // namespace datmo::samples
