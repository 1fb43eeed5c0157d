// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "datmo_fusion/common/options.h"

namespace datmo {

/// The box around the vehicle in which points are its own (hood, mirrors, roof rack), in base_link.
struct OwnVehicleOptions {
  double rear = -1.0;       ///< m
  double front = 1.0;       ///< m
  double half_width = 0.5;  ///< m

  void visit(OptionVisitor& visitor);
};

}  // namespace datmo
