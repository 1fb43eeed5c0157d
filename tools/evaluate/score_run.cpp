// SPDX-License-Identifier: BSD-3-Clause
#include "evaluate/score_run.h"

#include <optional>
#include <ostream>
#include <stdexcept>
#include <string>
#include <vector>

#include "evaluate/bag_loading.h"
#include "evaluate/matches_json.h"
#include "evaluate/run_score.h"
#include "evaluate/scan_loading.h"
#include "evaluate/score_json.h"

#include "datmo_fusion/ros/whole_file.h"

namespace datmo::evaluation {

namespace {

void remarkOn(const std::string& what, const Consistency& consistency, std::ostream& remarks) {
  if (consistency.unusable > 0) {
    remarks << "score_run: " << consistency.unusable << " of "
            << consistency.unusable + consistency.samples << " covariances of " << what
            << " are not positive definite: left out of its NEES\n";
  }
}

std::string textOf(const nlohmann::json& report) {
  return report.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

}  // namespace

void writeScore(const ScoreRunArguments& arguments, std::ostream& out, std::ostream& remarks) {
  const RecordedRun run = loadRun(arguments.run, arguments.options);
  const RecordedTruth truth = loadTruth(arguments.truth, arguments.options);
  std::optional<std::vector<Scan>> scans;
  if (!arguments.scans.empty()) {
    scans = loadScans(arguments.scans, arguments.options.topics);
  }
  const ScoredFiles files{arguments.run, arguments.truth};
  try {
    const RunScore score = scoreRun(run, truth, arguments.options, scans);
    std::vector<NamedText> texts;
    if (!arguments.matches.empty()) {
      const MatchOptions& matching = arguments.options.metrics.matching;
      texts.push_back({arguments.matches, textOf(matchesJson(score, matching))});
    }
    const std::string report = textOf(toJson(score, arguments.options, files));
    if (!arguments.output.empty()) {
      texts.push_back({arguments.output, report});
    }
    writeWholeFiles(texts);
    if (arguments.output.empty()) {
      out << report;
    }
    remarkOn("the tracks' position", score.tracks.consistency.position, remarks);
    remarkOn("the tracks' velocity", score.tracks.consistency.velocity, remarks);
    if (score.pose) {
      remarkOn("the vehicle's pose", score.pose->consistency, remarks);
    }
  } catch (const ScoreError& error) {
    throw std::runtime_error(files.run + ", " + files.truth + ": " + error.what());
  }
}

}  // namespace datmo::evaluation
