#pragma once

#include "datmo_fusion/common/options.h"

namespace datmo_fusion {

struct OccupancyMapOptions {
  void visit(OptionVisitor& visitor);
};

class OccupancyMap {};

}  // namespace datmo_fusion
