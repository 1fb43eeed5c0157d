// SPDX-License-Identifier: BSD-3-Clause
#include "evaluate/score_run_arguments.h"

#include <utility>

#include "command_line.h"
#include "output_bag.h"
#include "yaml_options.h"

#include "datmo_fusion/common/option_table.h"

namespace datmo::evaluation {

namespace {

/// What the command line names, before it is read.
struct Words {
  std::string run;
  std::string truth;
  std::string options;
  std::string output;
  std::string matches;
  std::string scans;
  std::vector<std::string> assignments;
};

ScoreOptions readScoreOptions(const Words& words) {
  OptionValues values;
  if (!words.options.empty()) {
    try {
      values = optionValues(loadYaml(words.options));
      readOptions<ScoreOptions>(values);
    } catch (const OptionError& error) {
      const std::string what = error.what();
      throw OptionError(what.rfind(words.options, 0) == 0 ? what : words.options + ": " + what);
    }
  }
  for (const std::string& assignment : words.assignments) {
    setOption(assignment, values);
  }
  return readOptions<ScoreOptions>(values);
}

}  // namespace

ScoreRunArguments parseScoreRunArguments(std::vector<std::string> words) {
  Words given;
  CommandLine line(
      "score_run",
      "Scores the tracks and poses of a run against ground truth and writes a report as JSON.",
      "bags");
  line.addFile("RUN.bag", given.run, "the bag with tracks and poses")->required();
  line.addFile("TRUTH.bag", given.truth, "the bag with /ground_truth/*; default: RUN.bag");
  line.addFile("--options", given.options, "criteria of a match", "FILE.yaml");
  line.addRepeated("--set", given.assignments, "one of the options, e.g. matching/gate=1.5",
                   "KEY=VALUE");
  line.addFile("--out", given.output, "report; default: standard output", "REPORT.json");
  line.addFile("--matches", given.matches, "which track is matched to which object, frame by frame",
               "MATCHES.json");
  line.addFile(
      "--attainable", given.scans,
      "compares delays with the minimum that its scans allow, for an observer who knows which "
      "beams end on which object",
      "DRIVE.bag");
  line.addAnswer("--list-options", optionTable<ScoreOptions>, "prints all options as a table");
  line.read(std::move(words));
  const std::string& truth = given.truth.empty() ? given.run : given.truth;
  for (const std::string& output : {given.output, given.matches}) {
    for (const std::string& input : {given.run, truth, given.options, given.scans}) {
      if (!output.empty() && isSameFile(output, input)) {
        throw UsageError(output + ": the report must not be an input");
      }
    }
  }
  if (!given.output.empty() && isSameFile(given.output, given.matches)) {
    throw UsageError("'" + given.output + "': expected another file for each output");
  }
  return {given.run, truth, given.output, given.matches, given.scans, readScoreOptions(given)};
}

}  // namespace datmo::evaluation
