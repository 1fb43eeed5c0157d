// SPDX-License-Identifier: BSD-3-Clause
// Converts clouds of a 3D lidar in a bag to planar scans: see clouds_to_scans.h.
#include <cstdlib>
#include <iostream>

#include "command_line.h"
#include "convert/clouds_to_scans.h"
#include "interruption.h"

#include <ros/time.h>

int main(int count, char** words) {
  return datmo::runProgram("clouds_to_scans", EXIT_FAILURE, count, words, [](const auto& given) {
    const datmo::CloudsToScansArguments arguments = datmo::parseCloudsToScans(given);
    ros::Time::init();
    datmo::noteInterruptions();
    const datmo::ConvertedClouds converted = datmo::convertClouds(arguments);
    std::cout << converted.scans << " scans, " << converted.dropped << " clouds dropped\n";
  });
}
