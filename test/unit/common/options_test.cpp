// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/common/options.h"

#include <limits>

#include <gtest/gtest.h>

#include "datmo_fusion/common/option_table.h"

namespace datmo {
namespace {

struct MapOptions {
  double cell_size = 0.3;
  int cells = 10;

  void visit(OptionVisitor& visitor) {
    visitor.number({"cell_size", "m", "side of a cell"}, cell_size, {0.05, 1.0});
    visitor.integer({"cells", "1", "cells a side"}, cells, {1, 100});
  }
};

struct StageOptions {
  MapOptions map;
  bool odometry = true;
  std::string echo = "nearest";
  std::string frame = "map";
  double gain = 1.0;

  void visit(OptionVisitor& visitor) {
    visitor.group("map", [&] { map.visit(visitor); });
    visitor.toggle({"odometry", "", "use it"}, odometry);
    visitor.text({"echo", "", "which one"}, echo, {"nearest", "last"});
    visitor.text({"frame", "", "fixed frame"}, frame, {});
    visitor.number({"gain", "1", "a|b"}, gain, {});
  }
};

std::string errorOf(const OptionValues& values) {
  try {
    readOptions<StageOptions>(values);
  } catch (const OptionError& error) {
    return error.what();
  }
  return "";
}

void expectMentions(const std::string& message, const std::vector<std::string>& parts) {
  for (const std::string& part : parts) {
    EXPECT_NE(message.find(part), std::string::npos) << "'" << part << "' not in: " << message;
  }
}

TEST(ReadOptions, NothingGivenLeavesTheDefaults) {
  const auto options = readOptions<StageOptions>({});
  EXPECT_EQ(options.map.cell_size, 0.3);
  EXPECT_EQ(options.map.cells, 10);
  EXPECT_TRUE(options.odometry);
  EXPECT_EQ(options.echo, "nearest");
}

TEST(ReadOptions, GivenValuesReplaceTheDefaults) {
  const auto options = readOptions<StageOptions>({{"map/cell_size", 0.1},
                                                  {"map/cells", 7},
                                                  {"odometry", false},
                                                  {"echo", std::string("last")},
                                                  {"frame", std::string("world")}});
  EXPECT_EQ(options.map.cell_size, 0.1);
  EXPECT_EQ(options.map.cells, 7);
  EXPECT_FALSE(options.odometry);
  EXPECT_EQ(options.echo, "last");
  EXPECT_EQ(options.frame, "world");
}

struct SourcesOptions {
  std::map<std::string, MapOptions> sources{{"lidar", {0.2, 5}}};

  void visit(OptionVisitor& visitor) { visitor.each({"sources", "", "each"}, sources); }
};

TEST(ReadOptions, ANameThatIsSetIsOneMoreEntry) {
  const auto options =
      readOptions<SourcesOptions>({{"sources/lidar/cells", 7}, {"sources/radar/cell_size", 0.5}});
  ASSERT_EQ(options.sources.size(), 2U);
  EXPECT_EQ(options.sources.at("lidar").cell_size, 0.2);
  EXPECT_EQ(options.sources.at("lidar").cells, 7);
  EXPECT_EQ(options.sources.at("radar").cell_size, 0.5);
  EXPECT_EQ(options.sources.at("radar").cells, 10);
}

TEST(ReadOptions, EntriesAreCheckedAndTheirKeysToo) {
  EXPECT_THROW(readOptions<SourcesOptions>({{"sources/lidar/cells", 0}}), OptionError);
  EXPECT_THROW(readOptions<SourcesOptions>({{"sources/lidar/cell", 1}}), OptionError);
  EXPECT_THROW(readOptions<SourcesOptions>({{"sources/lidar", 1}}), OptionError);
}

TEST(ReadOptions, AWholeNumberServesAsANumber) {
  EXPECT_EQ(readOptions<StageOptions>({{"map/cell_size", 1}}).map.cell_size, 1.0);
}

TEST(ReadOptions, WrongTypesAreRefusedWithNameValueAndExpectation) {
  expectMentions(errorOf({{"map/cells", 7.5}}), {"map/cells", "7.5", "a whole number"});
  expectMentions(errorOf({{"map/cell_size", std::string("big")}}),
                 {"map/cell_size", "'big'", "a number"});
  expectMentions(errorOf({{"map/cell_size", true}}), {"map/cell_size", "true", "a number"});
  expectMentions(errorOf({{"odometry", 1}}), {"odometry", "1", "true or false"});
  expectMentions(errorOf({{"frame", 3}}), {"frame", "3", "text"});
}

TEST(ReadOptions, ValuesOutOfBoundsAreRefused) {
  expectMentions(errorOf({{"map/cell_size", 0.01}}), {"map/cell_size", "0.01", "0.05", "1", "m"});
  expectMentions(errorOf({{"map/cells", 101}}), {"map/cells", "101"});
  expectMentions(errorOf({{"echo", std::string("first")}}), {"echo", "'first'", "'nearest'"});
  EXPECT_EQ(errorOf({{"map/cell_size", 0.05}, {"map/cells", 100}}), "") << "bounds are allowed";
}

TEST(ReadOptions, NumbersThatAreNotFiniteAreRefusedWithoutBoundsToo) {
  expectMentions(errorOf({{"gain", std::numeric_limits<double>::quiet_NaN()}}), {"gain", "nan"});
  expectMentions(errorOf({{"gain", std::numeric_limits<double>::infinity()}}), {"gain", "inf"});
}

TEST(ReadOptions, AMisspelledKeyIsRefusedAndTheNearestKeyNamed) {
  expectMentions(errorOf({{"map/cellsize", 0.1}}), {"map/cellsize", "0.1", "map/cell_size"});
  expectMentions(errorOf({{"cell_size", 0.1}}), {"cell_size", "map/cell_size"});
  expectMentions(errorOf({{"odometri", true}}), {"odometri", "nearest one is odometry"});
}

TEST(ReadOptions, TwoOptionsOfOneNameAreAMistakeOfTheProgram) {
  struct Twice {
    double value = 0.0;
    void visit(OptionVisitor& visitor) {
      visitor.number({"value", "m", ""}, value, {});
      visitor.number({"value", "m", ""}, value, {});
    }
  };
  EXPECT_THROW(readOptions<Twice>({}), std::logic_error);
}

TEST(OptionTable, HasALineForEachOption) {
  EXPECT_EQ(optionTable<StageOptions>(),
            "| parameter | unit | default | range | description |\n"
            "|---|---|---|---|---|\n"
            "| `map/cell_size` | m | 0.3 | 0.05 to 1 | side of a cell |\n"
            "| `map/cells` | 1 | 10 | 1 to 100 | cells a side |\n"
            "| `odometry` |  | true | true, false | use it |\n"
            "| `echo` |  | 'nearest' | nearest, last | which one |\n"
            "| `frame` |  | 'map' | any text | fixed frame |\n"
            "| `gain` | 1 | 1 | any number | a\\|b |\n");
}

TEST(OptionTable, HalfOpenRangesSaySo) {
  struct HalfOpen {
    double min = 1.0;
    double max = 1.0;
    void visit(OptionVisitor& visitor) {
      visitor.number({"a", "m", ""}, min, {0.5});
      visitor.number({"b", "m", ""}, max, {-std::numeric_limits<double>::infinity(), 2.5});
    }
  };
  const std::string table = optionTable<HalfOpen>();
  EXPECT_NE(table.find("| at least 0.5 |"), std::string::npos);
  EXPECT_NE(table.find("| at most 2.5 |"), std::string::npos);
}

}  // namespace
}  // namespace datmo
