#include "evaluation/score_run_arguments.h"

#include "output_bag.h"
#include "yaml_options.h"

namespace datmo::evaluation {

namespace {

/// The command line, word by word.
struct Words {
  std::vector<std::string> bags;
  std::string options;
  std::string output;
  OptionValues overrides;
};

bool takesValue(const std::string& word) {
  return word == "--options" || word == "--set" || word == "--out";
}

void takeValue(const std::string& word, const std::string& value, Words& words) {
  if (word == "--set") {
    setOption(value, words.overrides);
  } else if (value.empty()) {
    throw OptionError(word + " '': expected the name of a file");
  } else {
    (word == "--options" ? words.options : words.output) = value;
  }
}

Words sorted(const std::vector<std::string>& given) {
  Words words;
  for (std::size_t i = 0; i < given.size(); ++i) {
    const std::string& word = given[i];
    if (takesValue(word)) {
      if (i + 1 == given.size()) {
        throw OptionError(word + ": expected a value behind it");
      }
      takeValue(word, given[++i], words);
    } else if (word.empty() || word.front() == '-') {
      throw OptionError("'" + word + "': expected a bag, --options, --set or --out");
    } else {
      words.bags.push_back(word);
    }
  }
  return words;
}

ScoreOptions readScoreOptions(const Words& words) {
  OptionValues values;
  if (!words.options.empty()) {
    try {
      values = optionValues(loadYaml(words.options));
      readOptions<ScoreOptions>(values);
    } catch (const OptionError& error) {
      const std::string what = error.what();
      throw OptionError(what.rfind(words.options, 0) == 0 ? what : words.options + ": " + what);
    }
  }
  for (const auto& [key, value] : words.overrides) {
    values[key] = value;
  }
  return readOptions<ScoreOptions>(values);
}

}  // namespace

std::string scoreRunUsage() {
  return "usage: score_run RUN.bag [TRUTH.bag] [--options FILE.yaml] [--set KEY=VALUE]..."
         " [--out REPORT.json]\n"
         "       score_run --list-options\n"
         "Scores the tracks and poses of a run against ground truth and writes a report as JSON.\n"
         "  TRUTH.bag            holds /ground_truth/*; without it RUN.bag does\n"
         "  --options FILE.yaml  what counts as found; --list-options prints all keys as a table\n"
         "  --set KEY=VALUE      one of them, e.g. --set matching/gate=1.5\n"
         "  --out REPORT.json    else to standard output\n";
}

ScoreRunArguments parseScoreRunArguments(const std::vector<std::string>& words) {
  const Words given = sorted(words);
  if (given.bags.empty() || given.bags.size() > 2) {
    throw OptionError(std::to_string(given.bags.size()) +
                      " bags are named: expected that of the run, and that of the truth if it is "
                      "another");
  }
  for (const std::string& input : {given.bags.front(), given.bags.back(), given.options}) {
    if (!given.output.empty() && isSameFile(given.output, input)) {
      throw OptionError(given.output + ": the report must not be an input");
    }
  }
  return {given.bags.front(), given.bags.back(), given.output, readScoreOptions(given)};
}

}  // namespace datmo::evaluation
