// SPDX-License-Identifier: BSD-3-Clause
#include "command_line.h"

#include <gtest/gtest.h>

namespace datmo::command_line_test {
namespace {

enum class Speed { kSlow, kFast };

/// A command line with each kind of option.
struct Given {
  std::string input;
  std::string output;
  std::string report;
  std::vector<std::string> assignments;
  Speed speed = Speed::kSlow;
  bool quiet = false;
};

Given given(const std::vector<std::string>& words) {
  Given given;
  CommandLine line("convert", "Converts a bag.", "bags");
  line.addFile("IN.bag", given.input, "what is read")->required();
  line.addFile("OUT.bag", given.output, "what is written");
  line.addFile("--report", given.report, "writes a report", "FILE.json");
  line.addRepeated("--set", given.assignments, "one option", "KEY=VALUE");
  line.addChoice("--speed", given.speed,
                 Choices<Speed>{{"slow", Speed::kSlow}, {"fast", Speed::kFast}}, "slow or fast",
                 "SPEED");
  line.addAnswer(
      "--options", [] { return "a table\n"; }, "prints all options");
  CLI::Option* quiet = line.add_flag("--quiet", given.quiet, "says nothing");
  line.add_flag("--silent", "says less than nothing")->needs(quiet);
  line.read(words);
  return given;
}

std::string errorOf(const std::vector<std::string>& words) {
  try {
    given(words);
  } catch (const UsageError& error) {
    return error.what();
  }
  return "";
}

std::string answerTo(const std::vector<std::string>& words) {
  try {
    given(words);
  } catch (const Answer& answer) {
    return answer.what();
  }
  return "";
}

TEST(CommandLineTest, WordsInAnyOrder) {
  const Given all = given({"--set", "a=1", "in.bag", "--speed", "fast", "--set", "b=[2, 3]",
                           "out.bag", "--quiet", "--report", "r.json"});
  EXPECT_EQ(all.input, "in.bag");
  EXPECT_EQ(all.output, "out.bag");
  EXPECT_EQ(all.report, "r.json");
  EXPECT_EQ(all.assignments, (std::vector<std::string>{"a=1", "b=[2, 3]"}));
  EXPECT_EQ(all.speed, Speed::kFast);
  EXPECT_TRUE(all.quiet);
}

TEST(CommandLineTest, TheLastValueOfARepeatedOptionCounts) {
  EXPECT_EQ(given({"in.bag", "--report", "a", "--report", "b"}).report, "b");
}

TEST(CommandLineTest, ErrorsNameTheValueAndWhatWasExpected) {
  EXPECT_EQ(errorOf({}), "0 bags are given: expected IN.bag [OUT.bag]");
  EXPECT_EQ(errorOf({"a", "b", "c"}), "3 bags are given: expected IN.bag [OUT.bag]");
  EXPECT_EQ(errorOf({"a", "--fast"}),
            "'--fast': expected --report, --set, --speed, --options, --quiet or --silent");
  EXPECT_EQ(errorOf({"a", "--report"}), "--report: expected a value after it");
  EXPECT_EQ(errorOf({"a", "--report", ""}), "--report '': expected the name of a file");
  EXPECT_EQ(errorOf({"a", "--speed", "warp"}), "--speed 'warp': expected slow or fast");
  EXPECT_EQ(errorOf({"a", "--silent"}), "--silent: expected --quiet with it");
}

TEST(CommandLineTest, AnswersNeedNothingElse) {
  EXPECT_EQ(answerTo({"--options"}), "a table\n");
  const std::string help = answerTo({"--help"});
  EXPECT_NE(help.find("usage: convert"), std::string::npos) << help;
  EXPECT_NE(help.find("--report FILE.json"), std::string::npos) << help;
}

TEST(CommandLineTest, RemappingsAreRemoved) {
  std::vector<std::string> words{"in.bag", "scan:=front", "/cloud:=/top", "out.bag"};
  const std::vector<Remapping> remappings = takeRemappings(words, {"scan", "cloud"});
  ASSERT_EQ(remappings.size(), 2U);
  EXPECT_EQ(remappings[0].ours, "scan");
  EXPECT_EQ(remappings[0].theirs, "/front");
  EXPECT_EQ(remappings[1].ours, "cloud");
  EXPECT_EQ(remappings[1].theirs, "/top");
  EXPECT_EQ(words, (std::vector<std::string>{"in.bag", "out.bag"}));
}

TEST(CommandLineTest, RemappingsOfOtherTopicsAreRefused) {
  for (const std::string word : {"pose:=/x", "scan:="}) {
    std::vector<std::string> words{word};
    try {
      takeRemappings(words, {"scan", "cloud"});
      FAIL() << word;
    } catch (const UsageError& error) {
      EXPECT_EQ(error.what(),
                "'" + word + "': expected one of scan, cloud, followed by := and a topic");
    }
  }
}

int exitCode(const std::function<void()>& work) {
  std::string name = "convert";
  char* words[] = {name.data()};
  return runProgram(name, 5, 1, words, [&work](const auto& /*words*/) { work(); });
}

TEST(RunProgramTest, ExitCodes) {
  EXPECT_EQ(exitCode([] {}), 0);
  EXPECT_EQ(exitCode([] { throw Answer(""); }), 0);
  EXPECT_EQ(exitCode([] { throw UsageError("no bag"); }), 5);
  EXPECT_EQ(exitCode([] { throw std::runtime_error("no space"); }), 5);
  EXPECT_EQ(exitCode([] { throw NoUsableInput("no scan"); }), kNoUsableInput);
}

}  // namespace
}  // namespace datmo::command_line_test
