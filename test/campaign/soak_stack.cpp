// SPDX-License-Identifier: BSD-3-Clause
// The stack on a drive without end, in one process and without a master, as fast as it goes:
//   soak_stack CONFIG.yaml [--minutes N] [--max-tiles N] [--out FILE.json]
// Minutes: of data. Writes what each of them needed. The exit code is 1 if a message was dropped,
// no track came for a minute, or the heap grew by more than it may once the map is full.
#include <fstream>
#include <iostream>

#include "soaked_drive.h"
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <ros/console.h>
#include <ros/time.h>

namespace {

/// The share of the minutes in which windows, histories and the map fill.
constexpr double kSettledShare = 0.5;
/// MiB, by which the heap may be more or less from minute to minute, as the scene changes.
constexpr double kMaxChange = 1.0;
/// MiB an hour.
constexpr double kMaxGrowth = 1.0;

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

}  // namespace

int main(int argc, char** argv) {
  std::string config;
  unsigned minutes = 60;
  int max_tiles = 0;
  std::string out;
  CLI::App app("The stack on a drive without end, as fast as it goes.");
  app.add_option("config", config, "the sensor set")->required();
  app.add_option("--minutes", minutes, "of data")->check(CLI::Range(2, 1000000));
  app.add_option("--max-tiles", max_tiles, "of the map, so that it is full soon");
  app.add_option("--out", out, "what each minute needed, as JSON");
  CLI11_PARSE(app, argc, argv);
  ros::Time::init();
  ros::console::set_logger_level(ROSCONSOLE_DEFAULT_NAME, ros::console::levels::Fatal);

  datmo::campaign::SoakedDrive drive(config, max_tiles);
  nlohmann::json samples = nlohmann::json::array();
  std::vector<double> heap;
  for (unsigned minute = 0; minute < minutes; ++minute) {
    const datmo::campaign::SoakSample sample = drive.nextMinute();
    heap.push_back(sample.heap_mib);
    samples.push_back(toJson(sample));
    std::cout << samples.back().dump() << std::endl;
  }
  std::vector<std::string> faults = drive.faults();
  const auto settled = static_cast<unsigned>(kSettledShare * minutes);
  const unsigned rest = minutes - 1 - settled;
  const double growth = heap.back() - heap[settled];
  if (growth > kMaxChange + kMaxGrowth * rest / 60.0) {
    faults.push_back("the heap grew by " + std::to_string(growth) + " MiB in the last " +
                     std::to_string(rest) + " minutes");
  }
  for (const std::string& fault : faults) {
    std::cout << fault << "\n";
  }
  if (!out.empty()) {
    std::ofstream(out) << nlohmann::json{{"samples", samples}, {"faults", faults}}.dump(1) << "\n";
  }
  return faults.empty() ? 0 : 1;
}
