// SPDX-License-Identifier: BSD-3-Clause
// Reads a sensor set's yaml file as run_bag does and prints its path; if it is invalid, prints the
// error and fails. perception.launch calls it, so that it does not start with an unknown section.
#include <cstdlib>
#include <iostream>
#include <string>
#include <vector>

#include "command_line.h"
#include "run_bag/sensor_set.h"

int main(int count, char** words) {
  return datmo::runProgram(
      "check_configuration", EXIT_FAILURE, count, words, [](const auto& given) {
        std::string file;
        std::vector<std::string> presets;
        datmo::CommandLine line("check_configuration", "Reads a sensor set and prints its path.",
                                "files");
        line.addFile("CONFIG.yaml", file, "the sensor set")->required();
        line.addRepeated("--preset", presets, "overrides the sensor set", "PRESET.yaml");
        line.read(given);
        datmo::SensorSet(file, presets);
        std::cout << file << '\n';
      });
}
