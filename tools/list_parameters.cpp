// Prints the parameters of all nodelets as Markdown, as they stand in doc/parameters.md.
#include <cstdlib>
#include <iostream>
#include <string>

#include "parameter_tables.h"

int main(int count, char** words) {
  if (count > 1) {
    const std::string word = words[1];
    const bool asks_for_help = word == "-h" || word == "--help";
    (asks_for_help ? std::cout : std::cerr) << "usage: list_parameters\n";
    return asks_for_help ? EXIT_SUCCESS : EXIT_FAILURE;
  }
  std::cout << datmo::parameterTables();
  return EXIT_SUCCESS;
}
