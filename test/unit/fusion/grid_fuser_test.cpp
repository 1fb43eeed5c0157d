// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/fusion/grid/grid_fuser.h"

#include <memory>
#include <optional>
#include <string>
#include <utility>

#include <gtest/gtest.h>

namespace datmo::grid_fuser_test {
namespace {

constexpr Percent kOccupied = 80;
constexpr Percent kFree = 20;
const GridWindow kWindow{1.0, 20, 20, {-10, -10}};

/// The vehicle drives ahead at 10 m/s.
std::optional<Pose2> ahead(Stamp from, Stamp to) {
  EXPECT_TRUE(from < to);
  return Pose2(10.0 * secondsBetween(from, to), 0.0, 0.0);
}

std::optional<Pose2> notKnown(Stamp, Stamp) { return std::nullopt; }

MatchedGrid matched(const std::string& source, double seconds, CellIndex occupied) {
  SensorGrid grid(Stamp::fromSeconds(seconds), kWindow);
  for (Percent& cell : grid.cells()) {
    cell = kFree;
  }
  grid.at(occupied) = kOccupied;
  return {source, grid.stamp(), std::make_shared<const SensorGrid>(grid)};
}

GridFuserOptions standingWorld(FusionRule rule) {
  GridFuserOptions options;
  options.rule = rule;
  options.mover_speed = 0.0;
  return options;
}

TEST(GridFuserTest, GridsAreMovedToTheStampOfTheReference) {
  const GridFuser fuser(standingWorld(FusionRule::kWeightedSum));
  // The same obstacle, 3.5 m ahead at 5.0 s.
  for (const auto& [seconds, column] : {std::pair(4.9, 4), std::pair(5.0, 3), std::pair(5.1, 2)}) {
    const FusionResult result = fuser.fuse(
        {{matched("lidar", 5.0, {3, 0}), matched("stereo", seconds, {column, 0})}, {}}, ahead);
    EXPECT_EQ(result.grids.fused.stamp(), Stamp::fromSeconds(5.0));
    EXPECT_EQ(result.grids.fused.at({3, 0}), kOccupied) << seconds;
    EXPECT_EQ(result.grids.fused.at({4, 0}), kFree) << seconds;
    EXPECT_EQ(result.grids.fused.at({2, 0}), kFree) << seconds;
    EXPECT_TRUE(result.missing.empty());
  }
}

TEST(GridFuserTest, CellsThatAMoverMayHaveReachedAreNotFree) {
  GridFuserOptions options = standingWorld(FusionRule::kPriority);
  options.mover_speed = 15.0;
  const GridFuser fuser(options);
  // In 0.1 s it comes 1.5 m closer: from stereo's column 6 to the lidar's column 7.
  const FusionResult result =
      fuser.fuse({{matched("lidar", 5.0, {7, 0}), matched("stereo", 4.9, {7, 0})}, {}}, ahead);
  EXPECT_EQ(result.grids.fused.at({6, 0}), kOccupied);
  EXPECT_EQ(result.grids.fused.at({7, 0}), kOccupied);
  EXPECT_EQ(result.grids.conflict.at({7, 0}), kUnknownPercent);
  EXPECT_EQ(result.grids.fused.at({8, 0}), kFree);
}

TEST(GridFuserTest, AtTheSameStampNoMotionNeedsToBeKnown) {
  const GridFuser fuser(standingWorld(FusionRule::kMaximum));
  const FusionResult result =
      fuser.fuse({{matched("lidar", 5.0, {3, 0}), matched("stereo", 5.0, {4, 0})}, {}}, notKnown);
  EXPECT_EQ(result.grids.fused.at({4, 0}), kOccupied);
  EXPECT_TRUE(result.missing.empty());
}

TEST(GridFuserTest, ASourceOfUnknownMotionIsLeftOutAndNamed) {
  const GridFuser fuser(standingWorld(FusionRule::kMaximum));
  const FusionResult result =
      fuser.fuse({{matched("lidar", 5.0, {3, 0}), matched("stereo", 4.95, {4, 0})},
                  {{"radar", WhyMissing::kSilent}}},
                 notKnown);
  EXPECT_EQ(result.grids.fused.at({3, 0}), kOccupied);
  EXPECT_EQ(result.grids.fused.at({4, 0}), kFree);
  EXPECT_EQ(result.grids.conflict.at({4, 0}), kUnknownPercent);
  ASSERT_EQ(result.missing.size(), 2U);
  EXPECT_EQ(result.missing[1].source, "stereo");
  EXPECT_EQ(result.missing[1].why, WhyMissing::kNoMotion);
}

TEST(GridFuserTest, OptionsAreReadUnderTheNameOfEachSource) {
  const auto options = readOptions<GridFuserOptions>({{"rule", std::string("log_odds")},
                                                      {"sources/radar/weight", 0.2},
                                                      {"sources/stereo/use", false}});
  EXPECT_EQ(GridFuser(options).rule(), FusionRule::kLogOdds);
  EXPECT_EQ(options.sourcesInUse(), std::vector<std::string>({"lidar", "radar"}));
  EXPECT_DOUBLE_EQ(options.sources.at("radar").weight, 0.2);
}

TEST(GridFuserTest, RefusesAnUnknownRule) {
  EXPECT_THROW(readOptions<GridFuserOptions>({{"rule", std::string("majority")}}), OptionError);
}

}  // namespace
}  // namespace datmo::grid_fuser_test
