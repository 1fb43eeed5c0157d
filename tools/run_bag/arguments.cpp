#include "arguments.h"

#include <array>

#include "output_bag.h"

namespace datmo {

namespace {

const std::array<std::string, 3> kInputTopics = {"scan", "echoes", "odometry"};

const std::map<std::string, LastStage> kStages = {{"grid_slam", LastStage::kGridSlam},
                                                  {"moving_objects", LastStage::kMovingObjects},
                                                  {"tracker", LastStage::kTracker}};

LastStage stageOf(const std::string& name) {
  const auto found = kStages.find(name);
  if (found == kStages.end()) {
    throw UsageError("--until '" + name + "': expected grid_slam, moving_objects or tracker");
  }
  return found->second;
}

std::string withSlash(const std::string& topic) {
  return topic.empty() || topic.front() == '/' ? topic : "/" + topic;
}

void addRemapping(const std::string& word, std::size_t separator, Arguments& arguments) {
  const std::string ours = word.substr(0, separator);
  const std::string theirs = word.substr(separator + 2);
  for (const std::string& topic : kInputTopics) {
    if (withSlash(ours) == withSlash(topic) && !theirs.empty()) {
      arguments.remappings[withSlash(ours)] = withSlash(theirs);
      return;
    }
  }
  throw UsageError("'" + word + "': expected scan:=, echoes:= or odometry:= and a topic");
}

void addFile(const std::string& word, Arguments& arguments) {
  if (arguments.input.empty()) {
    arguments.input = word;
  } else if (arguments.output.empty()) {
    arguments.output = word;
  } else {
    throw UsageError("'" + word + "': expected no more than an input and an output bag");
  }
}

void checkFiles(const Arguments& arguments) {
  if (arguments.output.empty()) {
    throw UsageError("expected an input and an output bag");
  }
  const bool with_times = !arguments.times.empty();
  for (const std::string& input : {arguments.input, arguments.config}) {
    if (isSameFile(arguments.output, input) || (with_times && isSameFile(arguments.times, input))) {
      throw UsageError("'" + input + "': the output must not be an input");
    }
  }
  if (with_times && isSameFile(arguments.times, arguments.output)) {
    throw UsageError("'" + arguments.times + "': expected two files for bag and times");
  }
  if (arguments.config.empty()) {
    throw UsageError("expected --config and a yaml file");
  }
}

}  // namespace

std::string Arguments::inputTopic(const std::string& topic) const {
  const auto remapped = remappings.find(withSlash(topic));
  return remapped == remappings.end() ? withSlash(topic) : remapped->second;
}

std::string usage() {
  return "usage: run_bag IN.bag OUT.bag --config CONFIG.yaml [--with-truth] [--quiet]"
         " [--until STAGE]\n"
         "               [--times FILE.json] [TOPIC:=TOPIC_OF_THE_BAG ...]\n"
         "Takes the scans and the odometry of a bag through the stack, as fast as it goes, and "
         "writes\n"
         "/pose, /map, /split_scan, /objects, /tracks and /tf to another bag.\n"
         "  --config CONFIG.yaml  the sensor set, e.g. config/demonstrator.yaml\n"
         "  --with-truth          copies /ground_truth/* along\n"
         "  --quiet               no progress bar and no table\n"
         "  --until STAGE         goes no further than grid_slam or moving_objects\n"
         "  --times FILE.json     how long each stage took for a message\n"
         "  TOPIC:=...            scan, echoes or odometry under another name\n";
}

Arguments parseArguments(const std::vector<std::string>& words) {
  Arguments arguments;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const std::string& word = words[i];
    const std::size_t separator = word.find(":=");
    if (word == "--with-truth") {
      arguments.with_truth = true;
    } else if (word == "--quiet") {
      arguments.quiet = true;
    } else if (word == "--config" && i + 1 < words.size()) {
      arguments.config = words[++i];
    } else if (word == "--until" && i + 1 < words.size()) {
      arguments.last_stage = stageOf(words[++i]);
    } else if (word == "--times" && i + 1 < words.size()) {
      arguments.times = words[++i];
    } else if (separator != std::string::npos) {
      addRemapping(word, separator, arguments);
    } else if (word.empty() || word.front() == '-') {
      throw UsageError("'" + word + "': no such option, or its value is missing");
    } else {
      addFile(word, arguments);
    }
  }
  checkFiles(arguments);
  return arguments;
}

}  // namespace datmo
