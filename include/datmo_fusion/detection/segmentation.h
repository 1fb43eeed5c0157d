#pragma once

#include <cstddef>
#include <vector>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/common/scan.h"

namespace datmo {

struct SegmentationOptions {
  double longest_gap = 2.0;   ///< m
  double shortest_gap = 0.6;  ///< m
  bool adaptive = true;
  double least_incidence = 0.5;  ///< rad

  void visit(OptionVisitor& visitor);
};

/// Indices of the points of one segment, in their order.
using Segment = std::vector<std::size_t>;

/// Cuts points, in beam order, where neighbours are too far apart to lie on one object.
///
/// Fixed: apart by more than `longest_gap` (thesis 3.3.1: 2 m). Adaptive: the breakpoint of Borges
/// & Aldon (Line extraction in 2D range images, 2004): on a surface that a beam meets at
/// `least_incidence` or more, the next beam ends within r sin(a) / sin(incidence - a), for the
/// angle a between the two; `shortest_gap` more than that, for its noise, and at most
/// `longest_gap`.
std::vector<Segment> segmentPoints(const std::vector<ScanPoint>& points,
                                   const SegmentationOptions& options);

}  // namespace datmo
