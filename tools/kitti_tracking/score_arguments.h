// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "kitti_tracking/tracking_evaluation.h"

namespace datmo::kitti {

/// What `kitti_tracking_score` is asked to do.
struct ScoreArguments {
  std::string labels;                ///< folder
  std::string results;               ///< folder
  std::vector<EvaluatedKind> kinds;  ///< one line of the table each
  Averaging averaging = Averaging::kOnce;
  std::string output;  ///< report, empty: none
};

/// Reads the words behind the program's name. Throws OptionError that says what is wrong and what
/// was expected, and Answer for --help.
ScoreArguments parseScoreArguments(std::vector<std::string> words);

}  // namespace datmo::kitti
