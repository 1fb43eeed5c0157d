// simulate scene.yaml out.bag [--seed N] [--set key=value]... [--quiet]
// A scene file becomes a bag of the demonstrator's sensors with ground truth.

#include <exception>
#include <iomanip>
#include <iostream>
#include <sstream>
#include <string>
#include <vector>

#include "interruption.h"
#include "output_bag.h"
#include "progress_bar.h"
#include "simulator/simulation_bag.h"
#include "yaml_options.h"
#include <unistd.h>

#include "datmo_fusion/common/option_table.h"

namespace {

using datmo::OptionError;
using datmo::ProgressBar;
using datmo::simulator::Scene;
using datmo::simulator::SimulationOptions;

constexpr const char* kUsage =
    "usage: simulate scene.yaml out.bag [--seed N] [--set key=value]... [--quiet]\n"
    "       simulate --options\n"
    "  --seed N         of all random numbers, instead of the scene's\n"
    "  --set key=value  an option instead of the scene's, e.g. --set scanner/beam_spacing=1\n"
    "  --quiet          no progress bar\n"
    "  --options        print all options as a table\n";

struct Arguments {
  std::vector<std::string> files;  ///< scene, bag
  datmo::OptionValues overrides;
  bool quiet = false;
};

Arguments parse(const std::vector<std::string>& words) {
  Arguments arguments;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const std::string& word = words[i];
    const bool takes_value = word == "--seed" || word == "--set";
    if (takes_value && i + 1 == words.size()) {
      throw OptionError(word + ": expected a value behind it");
    }
    if (word == "--seed") {
      datmo::setOption("seed=" + words[++i], arguments.overrides);
    } else if (word == "--set") {
      datmo::setOption(words[++i], arguments.overrides);
    } else if (word == "--quiet") {
      arguments.quiet = true;
    } else if (word.rfind('-', 0) == 0) {
      throw OptionError(word + ": expected --seed, --set, --quiet or --options");
    } else {
      arguments.files.push_back(word);
    }
  }
  if (arguments.files.size() != 2) {
    throw OptionError(std::to_string(arguments.files.size()) +
                      " files are named: expected a scene and a bag; simulate --help");
  }
  if (datmo::isSameFile(arguments.files[0], arguments.files[1])) {
    throw OptionError(arguments.files[1] + ": the bag must not be the scene");
  }
  return arguments;
}

std::string note(double time, double duration) {
  std::ostringstream text;
  text << std::fixed << std::setprecision(1) << time << " of " << duration << " s";
  return text.str();
}

/// False: interrupted.
bool simulate(const Arguments& arguments) {
  const Scene scene = datmo::simulator::readScene(arguments.files[0], arguments.overrides);
  ProgressBar bar(!arguments.quiet && isatty(STDERR_FILENO) != 0 ? &std::cerr : nullptr);
  const double duration = scene.options.duration;
  const bool complete = datmo::simulator::writeSimulationBag(
      scene, arguments.files[1], [&bar, duration](double time) {
        bar.show(time / duration, note(time, duration));
        return !datmo::interrupted();
      });
  return complete;
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string> words(argv + 1, argv + argc);
  if (words == std::vector<std::string>{"--help"} || words == std::vector<std::string>{"-h"}) {
    std::cout << kUsage;
    return 0;
  }
  if (words == std::vector<std::string>{"--options"}) {
    std::cout << datmo::optionTable<SimulationOptions>();
    return 0;
  }
  datmo::noteInterruptions();
  try {
    if (!simulate(parse(words))) {
      std::cerr << "simulate: interrupted, no bag written\n";
      return 1;
    }
  } catch (const std::exception& error) {
    std::cerr << "simulate: " << error.what() << "\n";
    return 1;
  }
  return 0;
}
