#pragma once

#include <string>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/common/scan.h"
#include "datmo_fusion/road/road_model.h"

namespace datmo {

struct RoadBorderDetectorOptions {
  std::string method = "tracked";

  void visit(OptionVisitor& visitor);
};

/// Finds the borders of the road in what scans of a planar scanner have hit, follows them, and
/// tells where they open into an intersection (thesis 3.5).
class RoadBorderDetector {
 public:
  /// Throws OptionError.
  explicit RoadBorderDetector(const RoadBorderDetectorOptions& options);

  /// Takes in a scan, by rising stamps; the road about the vehicle as far as it is known then.
  const RoadModel& update(const SplitScan& scan);

  /// Forgets all, as at the start.
  void reset();

 private:
  RoadBorderDetectorOptions options_;
  RoadModel road_;
};

}  // namespace datmo
