// SPDX-License-Identifier: BSD-3-Clause
#include "yaml_options.h"

#include <cstdio>
#include <fstream>
#include <map>

#include <gtest/gtest.h>

namespace datmo::yaml_options_test {
namespace {

OptionValues valuesOf(const std::string& text) { return optionValues(YAML::Load(text)); }

/// Returns the error message for a file with this text, after its name; empty: no error.
std::string refusalOf(const std::string& text) {
  const std::string file = testing::TempDir() + "yaml_options_test.yaml";
  std::ofstream(file) << text;
  std::string said;
  try {
    loadYaml(file);
  } catch (const OptionError& error) {
    said = error.what();
    EXPECT_EQ(said.rfind(file, 0), 0U) << said;
    said.erase(0, file.size());
  }
  std::remove(file.c_str());
  return said;
}

TEST(OptionValues, TypesAsWritten) {
  const OptionValues values = valuesOf("{a: true, b: 3, c: 3.5, d: word, e: '3', f: 1e-3}");
  EXPECT_EQ(std::get<bool>(values.at("a")), true);
  EXPECT_EQ(std::get<int>(values.at("b")), 3);
  EXPECT_EQ(std::get<double>(values.at("c")), 3.5);
  EXPECT_EQ(std::get<std::string>(values.at("d")), "word");
  EXPECT_EQ(std::get<std::string>(values.at("e")), "3");
  EXPECT_EQ(std::get<double>(values.at("f")), 1e-3);
}

TEST(OptionValues, SectionsAreFlattened) {
  const OptionValues values = valuesOf("{map: {window: {length: 90.0}}, rate: 5}");
  EXPECT_EQ(values.size(), 2U);
  EXPECT_EQ(std::get<double>(values.at("map/window/length")), 90.0);
}

TEST(OptionValues, NumbersMayBeListed) {
  const OptionValues values = valuesOf("{a: [1, 2.5], b: []}");
  EXPECT_EQ(std::get<std::vector<double>>(values.at("a")), (std::vector<double>{1.0, 2.5}));
  EXPECT_TRUE(std::get<std::vector<double>>(values.at("b")).empty());
}

TEST(OptionValues, EmptySectionHasNone) {
  EXPECT_TRUE(valuesOf("").empty());
  EXPECT_TRUE(optionValues(YAML::Load("{a: 1}")["b"]).empty());
}

TEST(OptionValues, NonOptionsAreRefused) {
  EXPECT_THROW(valuesOf("[1, 2]"), OptionError);
  EXPECT_THROW(valuesOf("5"), OptionError);
  EXPECT_THROW(valuesOf("{a: [1, none]}"), OptionError);
  EXPECT_THROW(valuesOf("{a: [1, [2]]}"), OptionError);
  EXPECT_THROW(valuesOf("{a: }"), OptionError);
  EXPECT_THROW(valuesOf("{a: 1, a: 2}"), OptionError);
}

TEST(ParseOptionValue, IsReadAsYaml) {
  EXPECT_EQ(std::get<double>(parseOptionValue("a", "2.5")), 2.5);
  EXPECT_EQ(std::get<bool>(parseOptionValue("a", "false")), false);
  EXPECT_THROW(parseOptionValue("a", "[1"), OptionError);
  EXPECT_THROW(parseOptionValue("a", ""), OptionError);
}

TEST(LoadYaml, SectionsAndKeysOfOneNameAreRefused) {
  for (const auto& [text, said] : std::map<std::string, std::string>{
           {"a: {b: 1}\nc: 2\na: {d: 3}\n", ":3: a is given twice: expected once"},
           {"a:\n  b: 1\n  b: 2\n", ":3: b is given twice: expected once"},
           {"a:\n  - {b: 1, b: 2}\n", ":2: b is given twice: expected once"}}) {
    EXPECT_EQ(refusalOf(text), said) << text;
  }
}

TEST(LoadYaml, ARecursiveAliasIsRefused) {
  const std::string said = ":2: expected yaml, but an alias stands for what it stands in";
  EXPECT_EQ(refusalOf("b: 1\na: &a [*a]\n"), said);
  EXPECT_EQ(refusalOf("b: 1\na: &a {b: {c: *a}}\n"), said);
}

TEST(LoadYaml, AliasExpansionIsBounded) {
  std::string text = "a0: &a0 [1, 1]\n";
  for (int level = 1; level <= 27; ++level) {
    const std::string below = "*a" + std::to_string(level - 1);
    const std::string name = "a" + std::to_string(level);
    text += name + ": &" + name + " [" + below + ", " + below + "]\n";
  }
  EXPECT_EQ(
      refusalOf(text),
      ":15: expected yaml, but there are more than 100000 values, including those of aliases");
  EXPECT_EQ(refusalOf("a: &a [1, 2]\nb: *a\nc: [*a, *a]\n"), "");
}

TEST(LoadYaml, DepthAndSizeAreBounded) {
  EXPECT_EQ(refusalOf("a: " + std::string(20000, '[')),
            ":1: expected yaml, but lists and maps are nested more than 100 deep");
  EXPECT_EQ(refusalOf("a: " + std::string(90, '[') + std::string(90, ']')), "");
  EXPECT_EQ(refusalOf("a: 1 #" + std::string(2'000'000, ' ')),
            ": expected yaml, but it has more than 1048576 bytes");
}

TEST(LoadYaml, MissingFilesAreRefused) {
  EXPECT_THROW(loadYaml(testing::TempDir()), OptionError);
  EXPECT_THROW(loadYaml(testing::TempDir() + "nowhere.yaml"), OptionError);
  EXPECT_THROW(loadYaml("/dev/zero"), OptionError);
}

}  // namespace
}  // namespace datmo::yaml_options_test
