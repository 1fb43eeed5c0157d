// SPDX-License-Identifier: BSD-3-Clause
#include "kitti_tracking/score_arguments.h"

#include <sstream>
#include <utility>

#include "command_line.h"

namespace datmo::kitti {

namespace {

constexpr char kDescription[] =
    "Scores tracks in KITTI's tracking format (NAME.txt per sequence, with scores) against its\n"
    "labels: the 3D metrics of Weng et al. 2020, averaged over 40 recalls, and CLEAR-MOT at the\n"
    "threshold with the highest MOTA.";

const std::vector<ObjectType> kAllClasses = {ObjectType::kCar, ObjectType::kPedestrian,
                                             ObjectType::kCyclist};

const Choices<std::vector<ObjectType>> kClasses = {{"car", {ObjectType::kCar}},
                                                   {"pedestrian", {ObjectType::kPedestrian}},
                                                   {"cyclist", {ObjectType::kCyclist}},
                                                   {"all", kAllClasses}};

const Choices<Averaging> kAveragings = {{"once", Averaging::kOnce},
                                        {"repeated", Averaging::kRepeated}};

/// The overlaps that Weng et al. 2020 report.
const std::vector<double> kPublishedOverlaps = {0.25, 0.5, 0.7};

std::vector<double> parseOverlaps(const std::string& text) {
  if (text == "all") {
    return kPublishedOverlaps;
  }
  std::istringstream stream(text);
  double overlap = 0.0;
  if (!(stream >> overlap) || !stream.eof() || !(overlap > 0.0 && overlap <= 1.0)) {
    throw UsageError("--iou '" + text + "': expected a number above 0 and up to 1, or all");
  }
  return {overlap};
}

}  // namespace

ScoreArguments parseScoreArguments(std::vector<std::string> words) {
  ScoreArguments arguments;
  std::vector<ObjectType> classes = kAllClasses;
  std::vector<double> overlaps = kPublishedOverlaps;
  CommandLine line("kitti_tracking_score", kDescription, "folders");
  line.addFile("LABELS_DIR", arguments.labels, "KITTI's labels")->required();
  line.addFile("RESULTS_DIR", arguments.results, "the tracks")->required();
  line.addChoice("--class", classes, kClasses, "car, pedestrian, cyclist or all (default)",
                 "CLASS");
  line.add_option_function<std::string>(
          "--iou", [&overlaps](const std::string& text) { overlaps = parseOverlaps(text); },
          "3D overlap of a match, above 0 and up to 1, or all (default): 0.25, 0.5 and 0.7")
      ->option_text("OVERLAP");
  line.addChoice(
      "--averaging", arguments.averaging, kAveragings,
      "averaging of a trajectory's scores: once (default), or repeated, with the rounding of\n"
      "the published evaluation",
      "HOW");
  line.addFile("--out", arguments.output, "writes all figures, also those of each recall",
               "REPORT.json");
  line.read(std::move(words));
  for (const ObjectType type : classes) {
    for (const double overlap : overlaps) {
      arguments.kinds.push_back({type, overlap});
    }
  }
  return arguments;
}

}  // namespace datmo::kitti
