// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "datmo_fusion/common/options.h"

namespace datmo {

/// The box, in base_link, whose points belong to the vehicle itself (hood, mirrors, roof rack).
struct OwnVehicleOptions {
  double rear = -1.0;       ///< m
  double front = 1.0;       ///< m
  double half_width = 0.5;  ///< m

  void visit(OptionVisitor& visitor);
};

}  // namespace datmo
