// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "datmo_fusion/common/object.h"
#include "datmo_fusion/common/options.h"
#include "datmo_fusion/tracking/target_motion.h"

namespace datmo {

/// Motion of tracked objects, by class.
struct ClassMotionOptions {
  TargetMotionOptions motion;  ///< of vehicles, and of objects of unknown class
  TargetMotionOptions pedestrian = pedestrianMotion();
  TargetMotionOptions cyclist = cyclistMotion();

  void visit(OptionVisitor& visitor);

  const TargetMotionOptions& motionOf(ObjectClass object_class) const;
};

}  // namespace datmo
