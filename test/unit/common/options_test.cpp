// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/common/options.h"

#include <limits>

#include <gtest/gtest.h>

#include "datmo_fusion/common/live_options.h"
#include "datmo_fusion/common/option_table.h"

namespace datmo::options_test {
namespace {

struct MapOptions {
  double cell_size = 0.3;
  int cells = 10;

  void visit(OptionVisitor& visitor) {
    visitor.number({"cell_size", "m", "side of a cell"}, cell_size, {0.05, 1.0});
    visitor.integer({"cells", "1", "cells a side"}, cells, {1, 100});
  }
};

enum class Echo { kNearest, kLast };

struct StageOptions {
  MapOptions map;
  bool odometry = true;
  Echo echo = Echo::kNearest;
  std::string frame = "map";
  double gain = 1.0;

  void visit(OptionVisitor& visitor) {
    visitor.group("map", [&] { map.visit(visitor); });
    visitor.toggle({"odometry", "", "use it"}, odometry);
    visitor.choice({"echo", "", "which one"}, echo,
                   {{"nearest", Echo::kNearest}, {"last", Echo::kLast}});
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
  EXPECT_EQ(options.echo, Echo::kNearest);
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
  EXPECT_EQ(options.echo, Echo::kLast);
  EXPECT_EQ(options.frame, "world");
}

struct SourcesOptions {
  std::map<std::string, MapOptions> sources{{"lidar", {0.2, 5}}};

  void visit(OptionVisitor& visitor) { visitor.each({"sources", "", "each"}, sources); }
};

TEST(ReadOptions, ASetNameAddsAnEntry) {
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

TEST(ReadOptions, AnIntegerIsAcceptedAsANumber) {
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

TEST(ReadOptions, DuplicateOptionNamesAreALogicError) {
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

/// Options of all tiers; everything in the group is of expert tier, whatever it says itself.
struct TieredOptions {
  double gate = 2.0;
  int points = 3;
  std::string rule = "mean";
  double noise = 0.1;

  void visit(OptionVisitor& visitor) {
    visitor.number({"gate", "1", "", Tier::kLive}, gate, {0.0, 10.0});
    visitor.integer({"points", "1", "", Tier::kPublic}, points, {1, 9});
    visitor.text({"rule", "", "", Tier::kLive}, rule, {"mean", "most"});
    visitor.group(
        "model",
        [&] {
          visitor.number({"noise", "m", "", Tier::kLive}, noise, {});
        },
        Tier::kExpert);
  }
};

TEST(OptionTable, TiersHaveTablesOfTheirOwn) {
  const std::string of_users = publicOptionTable<TieredOptions>();
  EXPECT_NE(of_users.find("`gate`"), std::string::npos);
  EXPECT_NE(of_users.find("*live*"), std::string::npos);
  EXPECT_NE(of_users.find("`points`"), std::string::npos);
  EXPECT_EQ(of_users.find("`model/noise`"), std::string::npos);
  const std::string of_experts = expertOptionTable<TieredOptions>();
  EXPECT_NE(of_experts.find("`model/noise`"), std::string::npos);
  EXPECT_EQ(of_experts.find("*live*"), std::string::npos);
  EXPECT_EQ(of_experts.find("`gate`"), std::string::npos);
  EXPECT_EQ(publicOptionTable<StageOptions>(), "") << "none of it is public";
}

TEST(LiveOptions, AreListedWithTheirCurrentValues) {
  TieredOptions options;
  options.gate = 5.0;
  const std::vector<LiveOption> live = liveOptions(options);
  ASSERT_EQ(live.size(), 2U);
  EXPECT_EQ(live[0].key, "gate");
  EXPECT_EQ(live[0].value, OptionValue(5.0));
  EXPECT_EQ(live[0].bounds.max, 10.0);
  EXPECT_EQ(live[1].choices, std::vector<std::string>({"mean", "most"}));
}

TEST(LiveOptions, AreChangedAndTheRestStays) {
  TieredOptions options;
  options.points = 7;
  const TieredOptions changed = withLiveValues(options, {{"gate", 4.0}});
  EXPECT_EQ(changed.gate, 4.0);
  EXPECT_EQ(changed.points, 7);
  EXPECT_EQ(changed.rule, "mean");
}

TEST(LiveOptions, OthersAndBadValuesAreRefused) {
  const TieredOptions options;
  EXPECT_THROW(withLiveValues(options, {{"points", 2}}), OptionError);
  EXPECT_THROW(withLiveValues(options, {{"model/noise", 0.2}}), OptionError);
  EXPECT_THROW(withLiveValues(options, {{"nothing", 0.2}}), OptionError);
  EXPECT_THROW(withLiveValues(options, {{"gate", 11.0}}), OptionError);
  EXPECT_THROW(withLiveValues(options, {{"rule", std::string("least")}}), OptionError);
}

struct RangeOptions {
  double min = 1.0;
  double max = 2.0;
  Echo echo = Echo::kNearest;

  void visit(OptionVisitor& visitor) {
    visitor.number({"min", "m", ""}, min, {0.0, 10.0});
    visitor.number({"max", "m", ""}, max, {0.0, 10.0});
    visitor.choice({"echo", "", ""}, echo, {{"nearest", Echo::kNearest}, {"last", Echo::kLast}});
  }
  void check() const {
    if (min > max) {
      throw OptionError("min: expected at most max");
    }
  }
};

TEST(CheckedOptions, AreValid) {
  RangeOptions options;
  options.max = 5.0;
  const Checked<RangeOptions> checked = options;
  EXPECT_EQ(checked->max, 5.0);
  EXPECT_EQ((*Checked<RangeOptions>()).max, 2.0);
}

TEST(CheckedOptions, OutOfBoundsOrContradictingEachOtherAreRefused) {
  RangeOptions options;
  options.max = 11.0;
  EXPECT_THROW(Checked<RangeOptions>{options}, OptionError);
  options.max = 0.5;
  EXPECT_THROW(Checked<RangeOptions>{options}, OptionError);
  EXPECT_THROW(readOptions<RangeOptions>({{"min", 3.0}}), OptionError);
  options = RangeOptions();
  options.echo = static_cast<Echo>(7);
  EXPECT_THROW(Checked<RangeOptions>{options}, OptionError);
}

TEST(OptionTable, HalfOpenRangesAreReportedAsSuch) {
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
}  // namespace datmo::options_test
