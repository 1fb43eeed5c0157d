#pragma once

#include <string>
#include <vector>

#include "evaluation/score_options.h"

namespace datmo::evaluation {

/// What `score_run` is asked to do.
struct ScoreRunArguments {
  std::string run;     ///< bag
  std::string truth;   ///< bag, maybe the same
  std::string output;  ///< report, empty: standard output
  ScoreOptions options;
};

/// How `score_run` is called.
std::string scoreRunUsage();

/// Reads the command line, and the options' file that it names. Throws OptionError that says what
/// is wrong and what was expected.
ScoreRunArguments parseScoreRunArguments(const std::vector<std::string>& words);

}  // namespace datmo::evaluation
