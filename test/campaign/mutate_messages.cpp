// SPDX-License-Identifier: BSD-3-Clause
// Mutated messages at the inputs of all stages, in one process and without a master:
//   mutate_messages CONFIG.yaml [--seed N] [--drives N] [--seconds S] [--out FILE.json]
// One drive after the other, with the seeds N, N + 1, ...; each is reported if it fails. The exit
// code is 1 if any failed, and 2 if nothing could be run.
#include <chrono>
#include <iostream>

#include "command_line.h"
#include "mutated_drive.h"
#include <nlohmann/json.hpp>
#include <sys/resource.h>

#include <ros/console.h>
#include <ros/time.h>

#include "datmo_fusion/ros/whole_file.h"

namespace {

/// Peak memory so far, MiB.
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
  double max_seconds = 2.0;   // s of CPU time, for one message: a scan takes 0.06
  double max_memory = 512.0;  // MiB
  std::string out;
};

nlohmann::json report(const Arguments& arguments, unsigned drives,
                      const datmo::campaign::Tally& tally, const std::vector<std::string>& faults) {
  return {{"first_seed", arguments.seed},
          {"drives", drives},
          {"messages", tally.messages},
          {"mutated", tally.mutated},
          {"past_stamp_checks", tally.mutated - tally.stopped_by_stamp},
          {"mutated_on", tally.mutated_on},
          {"mutated_type", tally.mutated_type},
          {"refused", tally.refused},
          {"slowest_s", tally.slowest},
          {"slowest_on", tally.slowest_on},
          {"max_s", arguments.max_seconds},
          {"peak_memory_mib", peakMemory()},
          {"max_memory_mib", arguments.max_memory},
          {"faults", faults}};
}

/// What failed.
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
    datmo::campaign::MutatedDrive drive(arguments.config, seed, arguments.max_seconds, tally);
    for (const std::string& fault : drive.run()) {
      faults.push_back("seed " + std::to_string(seed) + ", " + fault);
      std::cout << "\n  " << fault;
    }
    std::cout << std::endl;
  }
  if (peakMemory() > arguments.max_memory) {
    faults.push_back("took " + std::to_string(peakMemory()) + " MiB, expected at most " +
                     std::to_string(arguments.max_memory) + " MiB");
  }
  return faults;
}

Arguments parse(const std::vector<std::string>& words) {
  Arguments arguments;
  datmo::CommandLine line("mutate_messages", "Mutated messages at the inputs of all stages.",
                          "files");
  line.addFile("CONFIG.yaml", arguments.config, "the sensor set")->required();
  line.add_option("--seed", arguments.seed, "of the first drive");
  line.add_option("--drives", arguments.drives, "how many");
  line.add_option("--seconds", arguments.seconds, "as many drives as begin in this time");
  line.add_option("--max-seconds", arguments.max_seconds,
                  "of a processor for one message; more is a fault");
  line.add_option("--max-memory", arguments.max_memory, "MiB of the process; more is a fault");
  line.addFile("--out", arguments.out, "what was done and what came", "FILE.json");
  line.read(words);
  return arguments;
}

/// Returns whether nothing failed.
bool campaign(const Arguments& arguments) {
  datmo::campaign::Tally tally;
  unsigned drives = 0;
  const std::vector<std::string> faults = run(arguments, tally, drives);
  const std::string done = report(arguments, drives, tally, faults).dump(1) + "\n";
  std::cout << done;
  if (!arguments.out.empty()) {
    datmo::writeWholeFile(arguments.out, done);
  }
  return faults.empty();
}

}  // namespace

int main(int argc, char** argv) {
  bool is_clean = true;
  const int code = datmo::runProgram("mutate_messages", 2, argc, argv, [&](const auto& words) {
    const Arguments arguments = parse(words);
    ros::Time::init();
    ros::console::set_logger_level(ROSCONSOLE_DEFAULT_NAME, ros::console::levels::Fatal);
    is_clean = campaign(arguments);
  });
  return is_clean ? code : 1;
}
