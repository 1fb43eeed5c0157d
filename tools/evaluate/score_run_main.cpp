// SPDX-License-Identifier: BSD-3-Clause
// Scores a bag of tracks against a bag of truth, with a report as JSON: see score_run.h.
#include <iostream>

#include "command_line.h"
#include "evaluate/score_run.h"
#include "interruption.h"

#include <ros/time.h>

namespace {

/// Anything that prevents a report: bags, options, an interruption.
constexpr int kNoReport = 2;

}  // namespace

int main(int count, char** words) {
  return datmo::runProgram("score_run", kNoReport, count, words, [](const auto& given) {
    const auto arguments = datmo::evaluation::parseScoreRunArguments(given);
    datmo::noteInterruptions();
    ros::Time::init();
    datmo::evaluation::writeScore(arguments, std::cout, std::cerr);
  });
}
