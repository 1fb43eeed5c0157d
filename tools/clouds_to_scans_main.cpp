// Clouds of a 3D lidar in a bag -> planar scans: see cloudsToScansUsage() and clouds_to_scans.h.
#include <cstdlib>
#include <iostream>

#include "clouds_to_scans.h"
#include "interruption.h"

#include <ros/time.h>

namespace {

constexpr int kNoUsableInput = 2;  // exit code, as the usage says

}  // namespace

int main(int count, char** words) {
  using namespace datmo;
  const std::vector<std::string> given(words + 1, words + count);
  if (given == std::vector<std::string>{"--help"} || given == std::vector<std::string>{"-h"}) {
    std::cout << cloudsToScansUsage();
    return EXIT_SUCCESS;
  }
  try {
    const CloudsToScansArguments arguments = parseCloudsToScans(given);
    ros::Time::init();
    noteInterruptions();
    const ConvertedClouds converted = convertClouds(arguments);
    std::cout << converted.scans << " scans, " << converted.dropped << " clouds dropped\n";
  } catch (const CloudsToScansUsageError& error) {
    std::cerr << "clouds_to_scans: " << error.what() << '\n' << cloudsToScansUsage();
    return EXIT_FAILURE;
  } catch (const NoUsableCloud& error) {
    std::cerr << "clouds_to_scans: " << error.what() << '\n';
    return kNoUsableInput;
  } catch (const std::exception& error) {
    std::cerr << "clouds_to_scans: " << error.what() << '\n';
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
