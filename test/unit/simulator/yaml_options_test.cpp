// SPDX-License-Identifier: BSD-3-Clause
#include "yaml_options.h"

#include <cstdio>
#include <fstream>
#include <map>

#include <gtest/gtest.h>

namespace datmo::yaml_options_test {
namespace {

OptionValues valuesOf(const std::string& text) { return optionValues(YAML::Load(text)); }

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

TEST(OptionValues, WhatIsNoOptionIsRefused) {
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
  const std::string file = testing::TempDir() + "yaml_options_test.yaml";
  for (const auto& [text, said] : std::map<std::string, std::string>{
           {"a: {b: 1}\nc: 2\na: {d: 3}\n", ":3: a is given twice: expected once"},
           {"a:\n  b: 1\n  b: 2\n", ":3: b is given twice: expected once"},
           {"a:\n  - {b: 1, b: 2}\n", ":2: b is given twice: expected once"}}) {
    std::ofstream(file) << text;
    try {
      loadYaml(file);
      ADD_FAILURE() << text;
    } catch (const OptionError& error) {
      EXPECT_EQ(error.what(), file + said);
    }
  }
  std::remove(file.c_str());
}

}  // namespace
}  // namespace datmo::yaml_options_test
