#pragma once

#include "datmo_fusion/common/options.h"

namespace datmo_fusion {

struct MotionModelOptions {
  void visit(OptionVisitor& visitor);
};

}  // namespace datmo_fusion
