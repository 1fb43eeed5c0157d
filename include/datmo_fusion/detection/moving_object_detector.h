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

/// Objects that move, or may move, in a scan that was split by the map (thesis 3.3.1): segments of
/// neighboring end points that the map does not know as static, each with a box and its
/// covariance, and how well each of its sides is known. A side that beams ended on is known to the
/// range noise; one that is only known as the end of another side, to the gap between two beams
/// there; a side that could not be seen is kHiddenSide. Where an end was seen, the box reaches half
/// a gap beyond the last point: as far as is expected.
///
/// Objects come with dynamic state kMoving (the map has seen their position free), kUnknown
/// (nothing was known of their position: the tracker decides) or kStatic (nothing was known of it,
/// but it joins on to something static). Objects by rising beam index. No state from scan to scan.
class MovingObjectDetector {
 public:
  /// Throws OptionError.
  explicit MovingObjectDetector(const Checked<MovingObjectDetectorOptions>& options);

  /// Objects in the frame of the scan's points (base_link).
  ObjectList detect(const LabeledScan& scan) const;

 private:
  Object makeObject(const std::vector<ScanPoint>& points, const Segment& segment,
                    const LabeledScan& scan) const;
  void setBox(Object& object, const ScanPoint& first, const ScanPoint& last,
              const LabeledScan& scan) const;

  MovingObjectDetectorOptions options_;
};

}  // namespace datmo
