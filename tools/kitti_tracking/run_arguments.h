// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "kitti_tracking/sequence_run.h"

namespace datmo::kitti {

/// What `kitti_tracking_run` is asked to do.
struct RunArguments {
  std::string detections;    ///< folder with Car, Pedestrian and Cyclist in it
  std::string calibrations;  ///< folder
  std::string results;       ///< folder, made where it is missing
  RunOptions options;
};

/// Reads the words behind the program's name, and the configurations. Throws OptionError that says
/// what is wrong and what was expected, and Answer for --help.
RunArguments parseRunArguments(std::vector<std::string> words);

}  // namespace datmo::kitti
