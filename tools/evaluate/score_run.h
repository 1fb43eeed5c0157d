// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <iosfwd>

#include "evaluate/score_run_arguments.h"

namespace datmo::evaluation {

/// Loads the bags, scores the run and writes the report, to `out` if no file is named, and the
/// matches of each frame if a file is named for them. Reports in `remarks` what could not be
/// scored. Text that is not UTF-8 gets replacement characters.
///
/// Throws std::exception with a readable message (loadRun, loadTruth, scoreRun); no report is
/// written then, and an earlier one is left unchanged.
void writeScore(const ScoreRunArguments& arguments, std::ostream& out, std::ostream& remarks);

}  // namespace datmo::evaluation
