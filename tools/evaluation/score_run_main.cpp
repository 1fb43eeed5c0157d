// Bags of tracks and of truth -> a report as JSON: see scoreRunUsage() and score_run.h.
#include <iostream>
#include <string>
#include <vector>

#include "evaluation/score_run.h"
#include "interruption.h"

#include <ros/time.h>

#include "datmo_fusion/common/option_table.h"

namespace {

/// Whatever prevents a report: bags, options, an interruption.
constexpr int kNoReport = 2;

}  // namespace

int main(int count, char** words) {
  using namespace datmo::evaluation;
  const std::vector<std::string> given(words + 1, words + count);
  if (given == std::vector<std::string>{"--help"} || given == std::vector<std::string>{"-h"}) {
    std::cout << scoreRunUsage();
    return 0;
  }
  if (given == std::vector<std::string>{"--list-options"}) {
    std::cout << datmo::optionTable<ScoreOptions>();
    return 0;
  }
  datmo::noteInterruptions();
  try {
    ros::Time::init();
    writeScore(parseScoreRunArguments(given), std::cout, std::cerr);
  } catch (const std::exception& error) {
    std::cerr << "score_run: " << error.what() << '\n';
    return kNoReport;
  }
  return 0;
}
