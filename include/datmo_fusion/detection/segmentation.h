#pragma once

#include "datmo_fusion/common/options.h"

namespace datmo_fusion {

struct SegmentationOptions {
  double distance_threshold = 2.0;  ///< m

  void visit(OptionVisitor& visitor);
};

}  // namespace datmo_fusion
