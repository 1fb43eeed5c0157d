// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "datmo_fusion/common/object.h"
#include "datmo_fusion/common/options.h"
#include "datmo_fusion/common/scan.h"
#include "datmo_fusion/detection/segmentation.h"

namespace datmo {

struct MovingObjectDetectorOptions {
  SegmentationOptions segmentation;
  double moving_share = 0.3;  ///< 0 to 1
  double max_size = 20.0;     ///< m
  int min_points = 1;
  double range_sigma = 0.1;      ///< m
  double position_sigma = 0.05;  ///< m

  void visit(OptionVisitor& visitor);
};

/// Detects objects that move, or may move, in a scan that was split by the map (thesis 3.3.1):
/// segments of neighboring end points that the map does not know as static, each with a box, its
/// covariance, and the uncertainty of each of its sides. A side that beams ended on is known to the
/// range noise; one known only as the end of another side, to the gap between two beams there; a
/// side that could not be seen is kHiddenSide. Where an end was seen, the box reaches half a gap
/// beyond the last point, which is the expected position.
///
/// The dynamic state is kMoving (the map has seen the position free), kUnknown (the position was
/// unknown: the tracker decides) or kStatic (unknown, but connected to something static). Objects
/// are in ascending beam order. No state is kept from scan to scan.
class MovingObjectDetector {
 public:
  /// Throws OptionError.
  explicit MovingObjectDetector(const Checked<MovingObjectDetectorOptions>& options);

  /// Returns the objects in the frame of the scan's points (base_link).
  ObjectList detect(const LabeledScan& scan) const;

 private:
  Object makeObject(const std::vector<ScanPoint>& points, const Segment& segment,
                    const LabeledScan& scan) const;
  void setBox(Object& object, const ScanPoint& first, const ScanPoint& last,
              const LabeledScan& scan) const;

  MovingObjectDetectorOptions options_;
};

}  // namespace datmo
