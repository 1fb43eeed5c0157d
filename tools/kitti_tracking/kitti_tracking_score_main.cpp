// Tracks and labels in KITTI's tracking format -> a table, and a report as JSON: see scoreUsage().
#include <iostream>
#include <string>
#include <vector>

#include "kitti_tracking/score_arguments.h"
#include "kitti_tracking/sequence_folders.h"
#include "kitti_tracking/tracking_evaluation.h"
#include "kitti_tracking/tracking_report.h"
#include "whole_file.h"

namespace {

/// Whatever prevents a score: arguments, files.
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
  const std::vector<std::string> given(words + 1, words + count);
  if (given == std::vector<std::string>{"--help"} || given == std::vector<std::string>{"-h"}) {
    std::cout << datmo::kitti::scoreUsage();
    return 0;
  }
  try {
    writeScores(datmo::kitti::parseScoreArguments(given));
  } catch (const std::exception& error) {
    std::cerr << "kitti_tracking_score: " << error.what() << '\n';
    return kNoScore;
  }
  return 0;
}
