#pragma once

#include <string>

#include "datmo_fusion/common/object.h"
#include "datmo_fusion/common/options.h"
#include "datmo_fusion/common/scan.h"
#include "datmo_fusion/detection/segmentation.h"

namespace datmo_fusion {

struct MovingObjectDetectorOptions {
  SegmentationOptions segmentation;

  void visit(OptionVisitor& visitor);
};

/// Objects that move, or may move, in a scan that was split by the map (thesis 3.3.1): segments of
/// neighbouring end points; a segment that the map has not seen as static becomes an object with a
/// box and its covariance.
///
/// Objects come with dynamic state kMoving (the map has seen their place free) or kUnknown (nothing
/// was known of their place: a tracker finds out). Segments that the map knows as static are left
/// out. No state from scan to scan.
class MovingObjectDetector {
 public:
  /// Throws OptionError.
  explicit MovingObjectDetector(const MovingObjectDetectorOptions& options);

  /// Objects in the frame of the scan's points (base_link), by rising beam index.
  ObjectList detect(const SplitScan& scan) const;

 private:
  MovingObjectDetectorOptions options_;
};

}  // namespace datmo_fusion
