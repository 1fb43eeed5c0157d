#pragma once

#include <cstdint>
#include <vector>

#include "datmo_fusion/common/object.h"
#include "datmo_fusion/common/options.h"
#include "datmo_fusion/common/scan.h"
#include "datmo_fusion/road/road_model.h"

namespace datmo {

struct BorderFilterOptions {
  void visit(OptionVisitor& visitor);
};

/// Why an object is a false alarm; values as in DroppedObject.msg.
enum class DropReason : std::uint8_t { kOnBorder, kBeyondBorder };

/// An object that was left out, and why.
struct DroppedObject {
  Object object;
  DropReason reason = DropReason::kOnBorder;
  RoadSide side = RoadSide::kLeft;
  double beyond = 0.0;  ///< m that it reaches beyond the border
  /// Logarithm of the odds that it moves over that its place is what reflects.
  double motion_evidence = 0.0;
};

/// Takes objects on and beyond the road's borders for false alarms (thesis 3.5.1), unless they move
/// consistently there (thesis 2.4, 6.2): a pedestrian on the footpath, a car out of a driveway.
class BorderFilter {
 public:
  /// Throws OptionError.
  explicit BorderFilter(const BorderFilterOptions& options);

  /// Removes from `objects`, which were found in `scan`, what is a false alarm by `road`; returns
  /// what was removed. Scans by rising stamps, all of them: those without objects too.
  std::vector<DroppedObject> filter(const SplitScan& scan, const RoadModel& road,
                                    ObjectList& objects);

  /// Forgets all, as at the start.
  void reset();
};

}  // namespace datmo
