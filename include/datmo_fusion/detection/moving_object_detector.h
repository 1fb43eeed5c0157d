#pragma once

#include "datmo_fusion/common/object.h"
#include "datmo_fusion/common/options.h"
#include "datmo_fusion/common/scan.h"
#include "datmo_fusion/detection/segmentation.h"

namespace datmo {

struct MovingObjectDetectorOptions {
  SegmentationOptions segmentation;
  double moving_share = 0.3;   ///< 0 to 1
  double largest_size = 20.0;  ///< m
  int least_points = 1;
  double range_sigma = 0.1;   ///< m
  double extent_sigma = 0.3;  ///< m

  void visit(OptionVisitor& visitor);
};

/// Objects that move, or may move, in a scan that was split by the map (thesis 3.3.1): segments of
/// neighbouring end points that the map does not know as static, each with a box and its
/// covariance.
///
/// Objects come with dynamic state kMoving (the map has seen their place free), kUnknown (nothing
/// was known of their place: a tracker finds out) or kStatic (nothing was known of their place, but
/// it joins on to something static). Objects by rising beam index. No state from scan to scan.
class MovingObjectDetector {
 public:
  /// Throws OptionError.
  explicit MovingObjectDetector(const MovingObjectDetectorOptions& options);

  /// Objects in the frame of the scan's points (base_link).
  ObjectList detect(const SplitScan& scan) const;

 private:
  Object makeObject(const std::vector<ScanPoint>& points, const Segment& segment,
                    const Pose2& scanner, double beam_spacing) const;

  MovingObjectDetectorOptions options_;
};

}  // namespace datmo
