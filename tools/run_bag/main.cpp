// The stack on a bag, without a master: see usage() and bag_run.h.
#include <cstdlib>
#include <iostream>

#include "arguments.h"
#include "bag_run.h"
#include <unistd.h>

#include <ros/time.h>
#include <rosbag/exceptions.h>

int main(int count, char** words) {
  using namespace datmo;
  try {
    const Arguments arguments = parseArguments({words + 1, words + count});
    ros::Time::init();
    runBag(arguments, std::cout, isatty(STDOUT_FILENO) != 0);
  } catch (const UsageError& error) {
    std::cerr << "run_bag: " << error.what() << '\n' << usage();
    return EXIT_FAILURE;
  } catch (const rosbag::BagException& error) {
    std::cerr << "run_bag: the input cannot be read to its end, or the output not be written: "
              << error.what() << '\n';
    return EXIT_FAILURE;
  } catch (const std::exception& error) {
    std::cerr << "run_bag: " << error.what() << '\n';
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
