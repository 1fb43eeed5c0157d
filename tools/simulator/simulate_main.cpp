// SPDX-License-Identifier: BSD-3-Clause
// Simulates a scene file to a bag of the demonstrator's sensors with ground truth.

#include <cstdlib>
#include <iomanip>
#include <iostream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "command_line.h"
#include "interruption.h"
#include "output_bag.h"
#include "progress_bar.h"
#include "simulator/simulation_bag.h"
#include "yaml_options.h"
#include <unistd.h>

#include "datmo_fusion/common/option_table.h"

namespace {

using datmo::ProgressBar;
using datmo::simulator::Scene;
using datmo::simulator::SimulationOptions;

struct Arguments {
  std::string scene;
  std::string bag;
  datmo::OptionValues overrides;
  bool quiet = false;
};

Arguments parse(const std::vector<std::string>& words) {
  Arguments arguments;
  std::string seed;
  std::vector<std::string> assignments;
  datmo::CommandLine line(
      "simulate",
      "Simulates a scene and writes a bag with the demonstrator's sensors and ground truth.",
      "files");
  line.addFile("SCENE.yaml", arguments.scene, "roads, vehicles and options")->required();
  line.addFile("OUT.bag", arguments.bag, "the drive")->required();
  line.add_option("--seed", seed, "random seed, instead of the scene's")->option_text("N");
  line.addRepeated("--set", assignments,
                   "an option instead of the scene's, e.g. scanner/beam_spacing=1", "KEY=VALUE");
  line.add_flag("--quiet", arguments.quiet, "no progress bar");
  line.addAnswer("--options", datmo::optionTable<SimulationOptions>,
                 "prints all options as a table");
  line.read(words);
  if (!seed.empty()) {
    assignments.push_back("seed=" + seed);
  }
  for (const std::string& assignment : assignments) {
    datmo::setOption(assignment, arguments.overrides);
  }
  if (datmo::isSameFile(arguments.scene, arguments.bag)) {
    throw datmo::UsageError(arguments.bag + ": the bag must not be the scene");
  }
  return arguments;
}

std::string note(double time, double duration) {
  std::ostringstream text;
  text << std::fixed << std::setprecision(1) << time << " of " << duration << " s";
  return text.str();
}

void simulate(const Arguments& arguments) {
  const Scene scene = datmo::simulator::readScene(arguments.scene, arguments.overrides);
  ProgressBar bar(!arguments.quiet && isatty(STDERR_FILENO) != 0 ? &std::cerr : nullptr);
  const double duration = scene.options.duration;
  const bool complete =
      datmo::simulator::writeSimulationBag(scene, arguments.bag, [&bar, duration](double time) {
        bar.show(time / duration, note(time, duration));
        return !datmo::interrupted();
      });
  if (!complete) {
    throw std::runtime_error("interrupted, no bag written");
  }
}

}  // namespace

int main(int count, char** words) {
  return datmo::runProgram("simulate", EXIT_FAILURE, count, words, [](const auto& given) {
    const Arguments arguments = parse(given);
    datmo::noteInterruptions();
    simulate(arguments);
  });
}
