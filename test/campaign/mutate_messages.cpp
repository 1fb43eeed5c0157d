// SPDX-License-Identifier: BSD-3-Clause
// Mutated messages at the inputs of all stages, in one process and without a master:
//   mutate_messages CONFIG.yaml [--seed N] [--drives N] [--seconds S] [--out FILE.json]
// Drive after drive, with the seeds N, N + 1, ...; each is said when something is wrong with it.
// The exit code is 1 if there was any.
#include <chrono>
#include <fstream>
#include <iostream>

#include "mutated_drive.h"
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>
#include <sys/resource.h>

#include <ros/console.h>
#include <ros/time.h>

namespace {

/// MiB, the most so far.
double peakMemory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

struct Arguments {
  std::string config;
  unsigned seed = 1;
  unsigned drives = 8;
  double seconds = 0.0;
  std::string out;
};

nlohmann::json report(const Arguments& arguments, unsigned drives,
                      const datmo::campaign::Tally& tally, const std::vector<std::string>& faults) {
  return {{"first_seed", arguments.seed},    {"drives", drives},
          {"messages", tally.messages},      {"mutated", tally.mutated},
          {"mutated_on", tally.mutated_on},  {"refused", tally.refused},
          {"slowest_s", tally.slowest},      {"slowest_on", tally.slowest_on},
          {"peak_memory_mib", peakMemory()}, {"faults", faults}};
}

/// What was wrong.
std::vector<std::string> run(const Arguments& arguments, datmo::campaign::Tally& tally,
                             unsigned& drives) {
  std::vector<std::string> faults;
  const auto begin = std::chrono::steady_clock::now();
  const auto seconds = [&] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  };
  for (; arguments.seconds > 0.0 ? seconds() < arguments.seconds : drives < arguments.drives;
       ++drives) {
    const unsigned seed = arguments.seed + drives;
    std::cout << "seed " << seed << std::flush;
    datmo::campaign::MutatedDrive drive(arguments.config, seed, tally);
    for (const std::string& fault : drive.run()) {
      faults.push_back("seed " + std::to_string(seed) + ", " + fault);
      std::cout << "\n  " << fault;
    }
    std::cout << std::endl;
  }
  return faults;
}

}  // namespace

int main(int argc, char** argv) {
  Arguments arguments;
  CLI::App app("Mutated messages at the inputs of all stages.");
  app.add_option("config", arguments.config, "the sensor set")->required();
  app.add_option("--seed", arguments.seed, "of the first drive");
  app.add_option("--drives", arguments.drives, "how many");
  app.add_option("--seconds", arguments.seconds, "as many drives as begin in this time");
  app.add_option("--out", arguments.out, "what was done and what came, as JSON");
  CLI11_PARSE(app, argc, argv);
  ros::Time::init();
  ros::console::set_logger_level(ROSCONSOLE_DEFAULT_NAME, ros::console::levels::Fatal);

  datmo::campaign::Tally tally;
  unsigned drives = 0;
  const std::vector<std::string> faults = run(arguments, tally, drives);
  const nlohmann::json done = report(arguments, drives, tally, faults);
  std::cout << done.dump(1) << "\n";
  if (!arguments.out.empty()) {
    std::ofstream(arguments.out) << done.dump(1) << "\n";
  }
  return faults.empty() ? 0 : 1;
}
