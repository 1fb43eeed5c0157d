// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/common/scan.h"

namespace datmo {

struct SegmentationOptions {
  double max_gap = 2.0;  ///< m
  double min_gap = 0.6;  ///< m
  bool adaptive = true;
  double min_incidence = 0.5;  ///< rad

  void visit(OptionVisitor& visitor);
};

/// Indices of the points of one segment, in order.
using Segment = std::vector<std::size_t>;

/// Splits points, in beam order, where neighbors are too far apart to lie on one object.
///
/// Fixed: farther apart than `max_gap` (thesis 3.3.1: 2 m). Adaptive: the breakpoint of Borges &
/// Aldon (Line extraction in 2D range images, 2004): on a surface that a beam hits at
/// `min_incidence` or more, the next beam ends within r sin(a) / sin(incidence - a), for the angle
/// a between the two; plus `min_gap` for noise, and at most `max_gap`.
std::vector<Segment> segmentPoints(const std::vector<ScanPoint>& points,
                                   const SegmentationOptions& options);

}  // namespace datmo
