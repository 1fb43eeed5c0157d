// SPDX-License-Identifier: BSD-3-Clause
// Assesses the risks of a scene from the ground truth, without the errors of the tracks.

#include <cstdlib>
#include <string>
#include <vector>

#include "command_line.h"
#include "output_bag.h"
#include "simulator/scene.h"
#include "simulator/simulation_messages.h"
#include "simulator/true_tracks.h"
#include "yaml_options.h"

#include "datmo_fusion/common/option_table.h"
#include "datmo_fusion/risk/risk_assessor.h"
#include "datmo_fusion/ros/convert/risk_conversion.h"
#include "datmo_fusion/ros/stage/stamp_check.h"

namespace {

using namespace datmo;             // NOLINT: a program
using namespace datmo::simulator;  // NOLINT

/// s of ROS time at the start, as simulate has it.
constexpr double kEpoch = 1000.0;

struct Arguments {
  std::string scene;
  std::string bag;
  OptionValues overrides;
  OptionValues risk;
};

Arguments parse(const std::vector<std::string>& words) {
  Arguments arguments;
  std::vector<std::string> of_scene;
  std::vector<std::string> of_risk;
  CommandLine line(
      "true_risks",
      "Assesses the risks of a scene from its true objects, and writes /risks with the\n"
      "ground truth for `evaluate risk`.",
      "files");
  line.addFile("SCENE.yaml", arguments.scene, "as for simulate")->required();
  line.addFile("OUT.bag", arguments.bag, "risks, true objects and contact")->required();
  line.addRepeated("--set", of_scene, "an option instead of the scene's", "KEY=VALUE");
  line.addRepeated("--risk", of_risk, "an option of the risk assessment, e.g. method=thesis",
                   "KEY=VALUE");
  line.addAnswer("--options", optionTable<RiskOptions>,
                 "prints all options of the risk assessment");
  line.read(words);
  for (const std::string& assignment : of_scene) {
    setOption(assignment, arguments.overrides);
  }
  for (const std::string& assignment : of_risk) {
    setOption(assignment, arguments.risk);
  }
  if (isSameFile(arguments.scene, arguments.bag)) {
    throw UsageError(arguments.bag + ": the bag must not be the scene");
  }
  return arguments;
}

void assess(const Arguments& arguments) {
  const Scene scene = readScene(arguments.scene, arguments.overrides);
  const auto options = readOptions<RiskOptions>(arguments.risk);
  RiskAssessor assessor(options);
  IdealTracker tracker(scene.world);
  LaserScanner scanner(scene.options.scanner,
                       {static_cast<std::uint64_t>(scene.options.seed), "scanner"});
  OutputBag bag(arguments.bag);
  const double end = scene.contact ? scene.contact->time : scene.options.duration;
  for (int i = 0; i / scene.options.scanner.scan_rate < end; ++i) {
    const double time = i / scene.options.scanner.scan_rate;
    const Stamp stamp = Stamp::fromSeconds(kEpoch + time);
    const WorldState state = scene.world.at(time);
    const auto truths = objectTruths(scene.world, state, scanner.measure(scene.world, time),
                                     {scanner.viewpoint()}, scene.options.ground_truth);
    RiskInput input;
    input.stamp = stamp;
    input.host = trueHost(scene.world, time, options.vehicle);
    const TruePerception perception = tracker.at(time, truths);
    input.tracks = {stamp, perception.tracks, {}};
    input.standing = perception.standing;
    bag.write("/ground_truth/objects", toTime(stamp), toMessage(truths, Pose2(), stamp));
    bag.write("/risks", toTime(stamp), toMessage(assessor.assess(input), "map"));
  }
  if (scene.contact) {
    const Stamp stamp = Stamp::fromSeconds(kEpoch + scene.contact->time);
    bag.write("/ground_truth/contact", toTime(stamp), toTrueContact(*scene.contact, stamp));
  }
  bag.finish();
}

}  // namespace

int main(int count, char** words) {
  return runProgram("true_risks", EXIT_FAILURE, count, words,
                    [](const auto& given) { assess(parse(given)); });
}
