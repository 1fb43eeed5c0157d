// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "kitti_tracking/sequence_run.h"

namespace datmo::kitti {

/// The command line of `kitti_tracking_run`.
struct RunArguments {
  std::string detections;    ///< folder with Car, Pedestrian and Cyclist in it
  std::string calibrations;  ///< folder
  std::string results;       ///< folder, created if it is missing
  RunOptions options;
};

/// Parses the words after the program's name, and reads the configurations. Throws OptionError with
/// the error and what was expected, and Answer for --help.
RunArguments parseRunArguments(std::vector<std::string> words);

}  // namespace datmo::kitti
