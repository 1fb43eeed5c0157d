// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "datmo_fusion/common/object.h"
#include "datmo_fusion/common/options.h"
#include "datmo_fusion/tracking/target_motion.h"

namespace datmo {

/// How tracked objects move, by class.
struct ClassMotionOptions {
  TargetMotionOptions motion;  ///< of vehicles, and of all whose class is not known
  TargetMotionOptions pedestrian = pedestrianMotion();
  TargetMotionOptions cyclist = cyclistMotion();

  void visit(OptionVisitor& visitor);

  const TargetMotionOptions& motionOf(ObjectClass object_class) const;
};

}  // namespace datmo
