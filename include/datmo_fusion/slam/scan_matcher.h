#pragma once

#include "datmo_fusion/common/options.h"

namespace datmo_fusion {

struct ScanMatcherOptions {
  void visit(OptionVisitor& visitor);
};

/// How well a scan fits the map.
struct MatchQuality {
  int matched_points = 0;  ///< end points that took part
  double score = 0.0;      ///< 0 to 1, mean occupancy of the map where they end
  bool accepted = false;   ///< false: the pose is the prediction alone
};

}  // namespace datmo_fusion
