// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "evaluate/score_options.h"

namespace datmo::evaluation {

/// What `score_run` is asked to do.
struct ScoreRunArguments {
  std::string run;      ///< bag
  std::string truth;    ///< bag, maybe the same
  std::string output;   ///< report, empty: standard output
  std::string matches;  ///< matches of each frame, empty: not wanted
  std::string scans;    ///< bag with the scans for attainable delays, empty: not wanted
  ScoreOptions options;
};

/// Reads the words behind the program's name, and the options' file that they name. Throws
/// OptionError that says what is wrong and what was expected, and Answer for --help and
/// --list-options.
ScoreRunArguments parseScoreRunArguments(std::vector<std::string> words);

}  // namespace datmo::evaluation
