// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "evaluate/recorded_data.h"
#include "evaluate/score_options.h"

namespace datmo::evaluation {

// Bags are checked whole while they are read, so that a report is of all or not made at all.
//
// Both throw std::runtime_error that names file, topic and stamp, and says what was expected: a
// file that is no bag or cut short, a topic that is missing or of another type, a stamp of zero or
// twice on a topic, an id twice in a message, a number that is not finite, frames that do not fit
// together; and after an interruption (interruption.h).

/// What a run of the stack left. Poses are needed unless ScoreOptions::align is none.
RecordedRun loadRun(const std::string& file, const ScoreOptions& options);

/// The ground truth. It must hold objects: one at least.
RecordedTruth loadTruth(const std::string& file, const ScoreOptions& options);

}  // namespace datmo::evaluation
