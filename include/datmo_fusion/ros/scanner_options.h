// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "datmo_fusion/common/angle.h"
#include "datmo_fusion/ros/convert/scan_conversion.h"

namespace datmo {

/// The planar scanner, for all stages: section `scanner` of a sensor set.
struct ScannerOptions {
  ScanConversionOptions scan;
  double range_sigma = 0.0;        ///< m; 0: unknown
  double end_margin = 3.0;         ///< in range_sigma
  double beam_width = 0.0;         ///< rad
  double max_tilt = degrees(5.0);  ///< rad

  void visit(OptionVisitor& visitor);
};

}  // namespace datmo
