// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "datmo_fusion/common/options.h"

namespace datmo {

/// The names of the coordinate frames (REP 105), for all stages: section `frames` of a sensor set.
struct FrameOptions {
  std::string map = "map";
  std::string odom = "odom";
  std::string base = "base_link";
  std::string scanner = "scanner";
  std::string camera;
  /// Prepended to all of these and to the frames of mounts and stages, for several vehicles in one
  /// tf.
  std::string prefix;

  void visit(OptionVisitor& visitor);
};

/// Throws OptionError unless map, odom and base are three different, non-empty names: tf accepts no
/// empty frame name, and no frame that is its own parent.
void checkFrames(const FrameOptions& frames);

}  // namespace datmo
