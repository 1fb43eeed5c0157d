// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "evaluate/score_options.h"

namespace datmo::evaluation {

/// The command line of `score_run`.
struct ScoreRunArguments {
  std::string run;      ///< bag
  std::string truth;    ///< bag, may be the same
  std::string output;   ///< report, empty: standard output
  std::string matches;  ///< matches of each frame, empty: not written
  std::string scans;    ///< bag with the scans for attainable delays, empty: not computed
  ScoreOptions options;
};

/// Parses the words after the program's name, and the options file that they name. Throws
/// OptionError with the error and what was expected, and Answer for --help and --list-options.
ScoreRunArguments parseScoreRunArguments(std::vector<std::string> words);

}  // namespace datmo::evaluation
