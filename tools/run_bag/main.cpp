// The stack on a bag, without a master: see usage() and bag_run.h.
#include <cstdlib>
#include <iostream>
#include <string>
#include <vector>

#include "arguments.h"
#include "bag_run.h"
#include "input_refusals.h"
#include "interruption.h"
#include <unistd.h>

#include <ros/time.h>

namespace {

constexpr int kNoUsableInput = 2;  // exit code, as usage() says

}  // namespace

int main(int count, char** words) {
  using namespace datmo;
  const std::vector<std::string> arguments_given(words + 1, words + count);
  if (arguments_given == std::vector<std::string>{"--help"} ||
      arguments_given == std::vector<std::string>{"-h"}) {
    std::cout << usage();
    return EXIT_SUCCESS;
  }
  try {
    const Arguments arguments = parseArguments(arguments_given);
    ros::Time::init();
    noteInterruptions();
    runBag(arguments, std::cout, isatty(STDERR_FILENO) != 0 ? &std::cerr : nullptr);
  } catch (const UsageError& error) {
    std::cerr << "run_bag: " << error.what() << '\n' << usage();
    return EXIT_FAILURE;
  } catch (const NoUsableInput& error) {
    std::cerr << "run_bag: " << error.what() << '\n';
    return kNoUsableInput;
  } catch (const std::exception& error) {
    std::cerr << "run_bag: " << error.what() << '\n';
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
