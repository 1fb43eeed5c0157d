// SPDX-License-Identifier: BSD-3-Clause
// The stack on an endless drive, in one process and without a master, as fast as possible:
//   soak_stack CONFIG.yaml [--minutes N] [--max-tiles N] [--out FILE.json]
// Minutes: of data. Writes what each of them needed. The exit code is 1 if a message was dropped,
// no track was published for a minute, or the heap or the CPU time of a scan grew by more than is
// allowed once the map is full, and 2 if nothing could be run.
#include <cstddef>
#include <iostream>
#include <string>
#include <vector>

#include "command_line.h"
#include "soaked_drive.h"
#include <CLI/Validators.hpp>
#include <nlohmann/json.hpp>

#include <ros/console.h>
#include <ros/time.h>

#include "datmo_fusion/common/quantile.h"
#include "datmo_fusion/ros/whole_file.h"

namespace {

/// Share of the minutes in which windows, histories and the map fill up.
constexpr double kSettledShare = 0.5;
/// Tolerance of the heap from minute to minute, as the scene changes, MiB.
constexpr double kMaxChange = 1.0;
/// MiB per hour.
constexpr double kMaxGrowth = 1.0;
/// Tolerance of a scan's CPU time in the last quarter, relative to the second.
constexpr double kMaxSlowing = 1.5;
/// Shorter runs have single minutes as quarters.
constexpr std::size_t kMinutesToJudge = 8;

nlohmann::json toJson(const datmo::campaign::SoakSample& sample) {
  return {{"hours", sample.hours},
          {"heap_mib", sample.heap_mib},
          {"resident_mib", sample.resident_mib},
          {"median_ms", sample.median_ms},
          {"percentile_99_ms", sample.percentile_99_ms},
          {"track_lists", sample.track_lists},
          {"tracks", sample.tracks},
          {"dropped", sample.dropped}};
}

struct Arguments {
  std::string config;
  unsigned minutes = 60;
  int max_tiles = 0;
  std::string out;
};

Arguments parse(const std::vector<std::string>& words) {
  Arguments arguments;
  datmo::CommandLine line("soak_stack", "The stack on a drive without end, as fast as it goes.",
                          "files");
  line.addFile("CONFIG.yaml", arguments.config, "the sensor set")->required();
  line.add_option("--minutes", arguments.minutes, "of data")->check(CLI::Range(2, 1000000));
  line.add_option("--max-tiles", arguments.max_tiles, "of the map, so that it is full soon");
  line.addFile("--out", arguments.out, "what each minute needed", "FILE.json");
  line.read(words);
  return arguments;
}

/// Returns in what way the heap's growth is a fault; empty: none.
std::string growthFault(const std::vector<double>& heap) {
  const auto settled = static_cast<std::size_t>(kSettledShare * static_cast<double>(heap.size()));
  const std::size_t rest = heap.size() - 1 - settled;
  const double growth = heap.back() - heap[settled];
  return growth > kMaxChange + kMaxGrowth * static_cast<double>(rest) / 60.0
             ? "the heap grew by " + std::to_string(growth) + " MiB in the last " +
                   std::to_string(rest) + " minutes"
             : "";
}

/// CPU time of a scan early and late, ms: the first quarter fills memory, and is left out.
struct ScanTimes {
  double second_quarter = 0.0;
  double last_quarter = 0.0;
};

/// `medians`: of two or more minutes, ms.
ScanTimes scanTimes(const std::vector<double>& medians) {
  constexpr std::size_t kQuarters = 4;
  const auto quarter = [&medians](std::size_t index) {
    const auto end_of = [&medians](std::size_t quarters) {
      return medians.begin() + static_cast<std::ptrdiff_t>(quarters * medians.size() / kQuarters);
    };
    return datmo::quantile(std::vector<double>(end_of(index), end_of(index + 1)), 0.5);
  };
  return {quarter(1), quarter(kQuarters - 1)};
}

/// Returns in what way the growth of a scan's CPU time is a fault; empty: none.
std::string slowingFault(const ScanTimes& times, std::size_t minutes) {
  if (minutes < kMinutesToJudge) {
    return "";
  }
  return times.last_quarter > kMaxSlowing * times.second_quarter
             ? "a scan took " + std::to_string(times.last_quarter) +
                   " ms of a processor in the last quarter, expected at most " +
                   std::to_string(kMaxSlowing) + " times the " +
                   std::to_string(times.second_quarter) + " ms in the second one"
             : "";
}

/// Returns whether nothing failed.
bool soak(const Arguments& arguments) {
  datmo::campaign::SoakedDrive drive(arguments.config, arguments.max_tiles);
  nlohmann::json samples = nlohmann::json::array();
  std::vector<double> heap;
  std::vector<double> medians;
  for (unsigned minute = 0; minute < arguments.minutes; ++minute) {
    const datmo::campaign::SoakSample sample = drive.nextMinute();
    heap.push_back(sample.heap_mib);
    medians.push_back(sample.median_ms);
    samples.push_back(toJson(sample));
    std::cout << samples.back().dump() << std::endl;
  }
  std::vector<std::string> faults = drive.faults();
  const ScanTimes times = scanTimes(medians);
  for (const std::string& fault : {growthFault(heap), slowingFault(times, medians.size())}) {
    if (!fault.empty()) {
      faults.push_back(fault);
    }
  }
  for (const std::string& fault : faults) {
    std::cout << fault << "\n";
  }
  if (!arguments.out.empty()) {
    const nlohmann::json done{{"samples", samples},
                              {"second_quarter_ms", times.second_quarter},
                              {"last_quarter_ms", times.last_quarter},
                              {"max_slowing", kMaxSlowing},
                              {"faults", faults}};
    datmo::writeWholeFile(arguments.out, done.dump(1) + "\n");
  }
  return faults.empty();
}

}  // namespace

int main(int argc, char** argv) {
  bool is_clean = true;
  const int code = datmo::runProgram("soak_stack", 2, argc, argv, [&](const auto& words) {
    const Arguments arguments = parse(words);
    ros::Time::init();
    ros::console::set_logger_level(ROSCONSOLE_DEFAULT_NAME, ros::console::levels::Fatal);
    is_clean = soak(arguments);
  });
  return is_clean ? code : 1;
}
