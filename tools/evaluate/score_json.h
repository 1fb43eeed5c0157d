// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "evaluate/run_score.h"
#include <nlohmann/json.hpp>

namespace datmo::evaluation {

/// Version of the report's layout.
inline constexpr int kReportFormat = 1;

/// The files that were scored, as given by the user.
struct ScoredFiles {
  std::string run;
  std::string truth;
};

/// The score as a report for programs: units are in the names (_m, _s, _rad …), null means no
/// sample, times are in s since `start_s`, positions in the map of the truth.
nlohmann::json toJson(const RunScore& score, const ScoreOptions& options, const ScoredFiles& files);

}  // namespace datmo::evaluation
