// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <iosfwd>

#include "evaluate/score_run_arguments.h"

namespace datmo::evaluation {

/// Loads the bags, scores the run and writes the report, to `out` where no file is named, and the
/// matches of each frame where a file is named for them. Says in `remarks` what could not be
/// judged. Text that is not UTF-8 gets replacement characters.
///
/// Throws std::exception with a message for people (loadRun, loadTruth, scoreRun); no report is
/// left behind then, and one that was there before is as it was.
void writeScore(const ScoreRunArguments& arguments, std::ostream& out, std::ostream& remarks);

}  // namespace datmo::evaluation
