// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "datmo_fusion/ros/stage/stamp_check.h"

namespace datmo {

/// How CameraView draws tracks on images.
struct CameraViewOptions {
  double max_distance = 80.0;   ///< m
  double track_timeout = 0.5;   ///< s
  double wait = 0.3;            ///< s
  double default_height = 1.5;  ///< m
  double min_size = 0.3;        ///< m
  double text_height = 14.0;    ///< px
  int line_width = 2;           ///< px
  StreamOptions input;

  void visit(OptionVisitor& visitor);
};

}  // namespace datmo
