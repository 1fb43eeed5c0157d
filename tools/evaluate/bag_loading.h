// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "evaluate/recorded_data.h"
#include "evaluate/score_options.h"

namespace datmo::evaluation {

// Bags are checked completely while they are read, so that a report covers everything or is not
// made at all.
//
// Both throw std::runtime_error that names file, topic and stamp, and what was expected: for a file
// that is not a bag or is truncated, a topic that is missing or of another type, a zero or repeated
// stamp on a topic, a repeated id in a message, a number that is not finite, inconsistent frames;
// and after an interruption (interruption.h).

/// Loads the results of a run of the stack. Poses are required unless ScoreOptions::align is none.
RecordedRun loadRun(const std::string& file, const ScoreOptions& options);

/// Loads the ground truth, which must contain at least one object.
RecordedTruth loadTruth(const std::string& file, const ScoreOptions& options);

}  // namespace datmo::evaluation
