// Reads a sensor set's yaml file as run_bag does and prints its path; says what is wrong with it
// and fails otherwise. perception.launch calls it, so that a file with an unknown section does not
// start.
#include <cstdlib>
#include <iostream>
#include <string>
#include <vector>

#include "run_bag/sensor_set.h"

int main(int count, char** words) {
  const std::vector<std::string> files(words + 1, words + count);
  const bool asks_for_help = count == 2 && (files[0] == "-h" || files[0] == "--help");
  if (files.size() != 1 || asks_for_help) {
    (asks_for_help ? std::cout : std::cerr) << "usage: check_configuration CONFIG.yaml\n";
    return asks_for_help ? EXIT_SUCCESS : EXIT_FAILURE;
  }
  try {
    datmo::SensorSet{files[0]};
  } catch (const std::exception& error) {
    std::cerr << "check_configuration: " << error.what() << '\n';
    return EXIT_FAILURE;
  }
  std::cout << files[0] << '\n';
  return EXIT_SUCCESS;
}
