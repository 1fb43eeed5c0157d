// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "kitti_tracking/tracking_evaluation.h"

namespace datmo::kitti {

/// The command line of `kitti_tracking_score`.
struct ScoreArguments {
  std::string labels;                ///< folder
  std::string results;               ///< folder
  std::vector<EvaluatedKind> kinds;  ///< one line of the table each
  Averaging averaging = Averaging::kOnce;
  std::string output;  ///< report, empty: none
};

/// Parses the words after the program's name. Throws OptionError with the error and what was
/// expected, and Answer for --help.
ScoreArguments parseScoreArguments(std::vector<std::string> words);

}  // namespace datmo::kitti
