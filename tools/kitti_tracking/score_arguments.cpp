#include "kitti_tracking/score_arguments.h"

#include <map>
#include <set>
#include <sstream>

#include "datmo_fusion/common/options.h"

namespace datmo::kitti {

namespace {

const std::map<std::string, std::vector<ObjectType>> kClasses = {
    {"car", {ObjectType::kCar}},
    {"pedestrian", {ObjectType::kPedestrian}},
    {"cyclist", {ObjectType::kCyclist}},
    {"all", {ObjectType::kCar, ObjectType::kPedestrian, ObjectType::kCyclist}},
};

const std::set<std::string> kOptions = {"--class", "--iou", "--averaging", "--out"};

/// The overlaps that Weng et al. 2020 report.
const std::vector<double> kPublishedOverlaps = {0.25, 0.5, 0.7};

/// The command line, word by word.
struct Words {
  std::vector<std::string> folders;
  std::map<std::string, std::string> options;
};

Words sorted(const std::vector<std::string>& given) {
  Words words;
  for (std::size_t i = 0; i < given.size(); ++i) {
    const std::string& word = given[i];
    if (kOptions.count(word) != 0) {
      if (i + 1 == given.size() || given[i + 1].empty()) {
        throw OptionError(word + ": expected a value behind it");
      }
      words.options[word] = given[++i];
    } else if (word.empty() || word.front() == '-') {
      throw OptionError("'" + word + "': expected a folder, --class, --iou, --averaging or --out");
    } else {
      words.folders.push_back(word);
    }
  }
  return words;
}

std::string optionOr(const Words& words, const std::string& option, const std::string& other) {
  const auto found = words.options.find(option);
  return found == words.options.end() ? other : found->second;
}

std::vector<ObjectType> parseClass(const std::string& name) {
  const auto found = kClasses.find(name);
  if (found == kClasses.end()) {
    throw OptionError("--class '" + name + "': expected car, pedestrian, cyclist or all");
  }
  return found->second;
}

std::vector<double> parseOverlaps(const std::string& text) {
  if (text == "all") {
    return kPublishedOverlaps;
  }
  std::istringstream stream(text);
  double overlap = 0.0;
  if (!(stream >> overlap) || !stream.eof() || !(overlap > 0.0 && overlap <= 1.0)) {
    throw OptionError("--iou '" + text + "': expected a number above 0 to 1, or all");
  }
  return {overlap};
}

Averaging parseAveraging(const std::string& name) {
  if (name != "once" && name != "repeated") {
    throw OptionError("--averaging '" + name + "': expected once or repeated");
  }
  return name == "once" ? Averaging::kOnce : Averaging::kRepeated;
}

}  // namespace

std::string scoreUsage() {
  return "usage: kitti_tracking_score LABELS_DIR RESULTS_DIR [--class CLASS] [--iou OVERLAP]"
         " [--averaging HOW] [--out REPORT.json]\n"
         "Scores tracks in KITTI's tracking format (NAME.txt a sequence, with scores) against its "
         "labels: the 3D metrics of Weng et al. 2020, averaged over 40 recalls, and CLEAR-MOT at "
         "the threshold of the greatest MOTA.\n"
         "  --class CLASS        car, pedestrian, cyclist or all (default)\n"
         "  --iou OVERLAP        3D overlap of a match, above 0 to 1, or all (default): 0.25, 0.5 "
         "and 0.7\n"
         "  --averaging HOW      of a trajectory's scores: once (default), or repeated, with the "
         "rounding of the published evaluation\n"
         "  --out REPORT.json    writes all figures, of each recall too\n";
}

ScoreArguments parseScoreArguments(const std::vector<std::string>& words) {
  const Words given = sorted(words);
  if (given.folders.size() != 2) {
    throw OptionError(std::to_string(given.folders.size()) +
                      " folders are named: expected that of the labels and that of the results");
  }
  ScoreArguments arguments;
  arguments.labels = given.folders[0];
  arguments.results = given.folders[1];
  arguments.averaging = parseAveraging(optionOr(given, "--averaging", "once"));
  arguments.output = optionOr(given, "--out", "");
  for (const ObjectType type : parseClass(optionOr(given, "--class", "all"))) {
    for (const double overlap : parseOverlaps(optionOr(given, "--iou", "all"))) {
      arguments.kinds.push_back({type, overlap});
    }
  }
  return arguments;
}

}  // namespace datmo::kitti
