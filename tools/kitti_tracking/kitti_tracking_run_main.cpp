// SPDX-License-Identifier: BSD-3-Clause
// Computes tracks in KITTI's format from detections of KITTI tracking sequences: see
// run_arguments.cpp.
#include <filesystem>
#include <iomanip>
#include <iostream>
#include <string>
#include <vector>

#include "command_line.h"
#include "kitti_tracking/run_arguments.h"
#include "kitti_tracking/sequence_folders.h"
#include "kitti_tracking/sequence_run.h"

#include "datmo_fusion/ros/whole_file.h"

namespace {

namespace fs = std::filesystem;
using datmo::kitti::DetectedSequence;
using datmo::kitti::SequenceRun;

/// Anything that prevents tracks: arguments, files.
constexpr int kNoTracks = 2;

/// Folders of the detections, in the order of kTrackedTypes.
DetectedSequence readSequence(const std::string& name,
                              const datmo::kitti::RunArguments& arguments) {
  DetectedSequence sequence;
  sequence.name = name;
  sequence.calibration =
      datmo::kitti::readCalibration((fs::path(arguments.calibrations) / (name + ".txt")).string());
  for (std::size_t i = 0; i < datmo::kitti::kTrackedClasses; ++i) {
    const fs::path file = fs::path(arguments.detections) /
                          nameOf(datmo::kitti::kTrackedTypes.at(i)) / (name + ".txt");
    if (fs::exists(file)) {
      sequence.detections.at(i) = datmo::kitti::readDetections(file.string());
    }
  }
  return sequence;
}

void write(const SequenceRun& run, const fs::path& file) {
  std::string text;
  for (const datmo::kitti::TrackedObject& row : run.rows) {
    text += resultLine(row) + "\n";
  }
  datmo::writeWholeFile(file.string(), text);
}

void printSpeed(const SequenceRun& total) {
  const auto rate = [&](double seconds) { return static_cast<double>(total.frames) / seconds; };
  std::cout << std::fixed << std::setprecision(0) << total.frames << " frames; "
            << rate(total.tracking_seconds) << " frames/s by the trackers of all three classes, "
            << rate(total.tracking_seconds + total.ego_motion_seconds)
            << " with the vehicle's motion; one core\n";
}

void runAll(const datmo::kitti::RunArguments& arguments) {
  fs::create_directories(arguments.results);
  SequenceRun total;
  for (const std::string& name : datmo::kitti::sequencesIn(arguments.calibrations)) {
    const SequenceRun run = runSequence(readSequence(name, arguments), arguments.options);
    write(run, fs::path(arguments.results) / (name + ".txt"));
    total.frames += run.frames;
    total.tracking_seconds += run.tracking_seconds;
    total.ego_motion_seconds += run.ego_motion_seconds;
  }
  printSpeed(total);
}

}  // namespace

int main(int count, char** words) {
  return datmo::runProgram("kitti_tracking_run", kNoTracks, count, words, [](const auto& given) {
    runAll(datmo::kitti::parseRunArguments(given));
  });
}
