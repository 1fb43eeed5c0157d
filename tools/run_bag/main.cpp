// SPDX-License-Identifier: BSD-3-Clause
// Runs the stack on a bag, without a master: see arguments.cpp and bag_run.h.
#include <cstdlib>
#include <iostream>

#include "arguments.h"
#include "bag_run.h"
#include "command_line.h"
#include "interruption.h"
#include <unistd.h>

#include <ros/time.h>

int main(int count, char** words) {
  return datmo::runProgram("run_bag", EXIT_FAILURE, count, words, [](const auto& given) {
    const datmo::Arguments arguments = datmo::parseArguments(given);
    ros::Time::init();
    datmo::noteInterruptions();
    datmo::runBag(arguments, std::cout, isatty(STDERR_FILENO) != 0 ? &std::cerr : nullptr);
  });
}
