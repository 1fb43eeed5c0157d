// SPDX-License-Identifier: BSD-3-Clause
// Prints the parameters of all nodelets as Markdown (doc/parameters.md).
#include <cstdlib>
#include <iostream>

#include "command_line.h"
#include "parameter_tables.h"

int main(int count, char** words) {
  return datmo::runProgram("list_parameters", EXIT_FAILURE, count, words, [](const auto& given) {
    datmo::CommandLine line("list_parameters", "Prints the parameters of all nodelets as Markdown.",
                            "files");
    line.read(given);
    std::cout << datmo::parameterTables();
  });
}
