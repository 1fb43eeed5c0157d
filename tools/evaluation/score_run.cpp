#include "evaluation/score_run.h"

#include <ostream>
#include <stdexcept>

#include "evaluation/bag_loading.h"
#include "evaluation/run_score.h"
#include "evaluation/score_json.h"
#include "whole_file.h"

namespace datmo::evaluation {

void writeScore(const ScoreRunArguments& arguments, std::ostream& out) {
  const RecordedRun run = loadRun(arguments.run, arguments.options);
  const RecordedTruth truth = loadTruth(arguments.truth, arguments.options);
  const ScoredFiles files{arguments.run, arguments.truth};
  try {
    const RunScore score = scoreRun(run, truth, arguments.options);
    const std::string report = toJson(score, arguments.options, files).dump() + "\n";
    if (arguments.output.empty()) {
      out << report;
    } else {
      writeWholeFile(arguments.output, report);
    }
  } catch (const ScoreError& error) {
    throw std::runtime_error(files.run + ", " + files.truth + ": " + error.what());
  }
}

}  // namespace datmo::evaluation
