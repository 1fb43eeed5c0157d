// SPDX-License-Identifier: BSD-3-Clause
// Scores tracks against labels in KITTI's tracking format, with a table and a report as JSON: see
// score_arguments.cpp.
#include <iostream>
#include <string>
#include <vector>

#include "command_line.h"
#include "kitti_tracking/score_arguments.h"
#include "kitti_tracking/sequence_folders.h"
#include "kitti_tracking/tracking_evaluation.h"
#include "kitti_tracking/tracking_report.h"

#include "datmo_fusion/ros/whole_file.h"

namespace {

/// Anything that prevents a score: arguments, files.
constexpr int kNoScore = 2;

void writeScores(const datmo::kitti::ScoreArguments& arguments) {
  const auto sequences = datmo::kitti::readSequences(arguments.labels, arguments.results);
  std::vector<datmo::kitti::TrackingScore> scores;
  for (const datmo::kitti::EvaluatedKind& kind : arguments.kinds) {
    scores.push_back(datmo::kitti::evaluateTracking(sequences, kind, arguments.averaging));
  }
  std::cout << datmo::kitti::toTable(scores);
  if (!arguments.output.empty()) {
    datmo::writeWholeFile(arguments.output, datmo::kitti::toJson(scores).dump() + "\n");
  }
}

}  // namespace

int main(int count, char** words) {
  return datmo::runProgram("kitti_tracking_score", kNoScore, count, words, [](const auto& given) {
    writeScores(datmo::kitti::parseScoreArguments(given));
  });
}
