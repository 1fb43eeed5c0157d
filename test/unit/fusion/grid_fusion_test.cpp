// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/fusion/grid/grid_fusion.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include "datmo_fusion/common/random.h"

namespace datmo::grid_fusion_test {
namespace {

const std::vector<FusionRule> kAllRules = {FusionRule::kWeightedSum, FusionRule::kPriority,
                                           FusionRule::kMaximum, FusionRule::kLogOdds,
                                           FusionRule::kDempsterShafer};

GridSourceOptions source(int priority = 0, double weight = 0.5, double reliability = 1.0) {
  GridSourceOptions options;
  options.priority = priority;
  options.weight = weight;
  options.reliability = reliability;
  return options;
}

/// One source's value of the only cell.
struct Said {
  Percent percent;
  GridSourceOptions source = {};
};

SensorGrid oneCell(Percent percent) {
  SensorGrid grid(Stamp{1}, {1.0, 1, 1, {0, 0}});
  grid.at({0, 0}) = percent;
  return grid;
}

FusedGrids fuse(FusionRule rule, const std::vector<Said>& all) {
  std::vector<SensorGrid> grids;
  std::vector<WeightedGrid> weighed;
  grids.reserve(all.size());
  for (const Said& said : all) {
    grids.push_back(oneCell(said.percent));
    weighed.push_back({&grids.back(), said.source});
  }
  return fuseGrids(rule, weighed);
}

int fused(FusionRule rule, const std::vector<Said>& all) {
  return fuse(rule, all).fused.at({0, 0});
}

int conflict(const std::vector<Said>& all) {
  return fuse(FusionRule::kMaximum, all).conflict.at({0, 0});
}

TEST(GridFusionTest, ACellKnownToOneSourceHasItsValue) {
  for (const FusionRule rule : kAllRules) {
    for (const Percent percent : std::vector<Percent>{0, 20, 50, 80, 100}) {
      EXPECT_EQ(fused(rule, {{percent, source(0, 0.2, 0.5)}, {kUnknownPercent, source(9)}}),
                percent);
      EXPECT_EQ(fused(rule, {{kUnknownPercent, source(9)}, {percent, source(0, 0.2, 0.5)}}),
                percent);
    }
    EXPECT_EQ(fused(rule, {{kUnknownPercent}, {kUnknownPercent}}), kUnknownPercent);
  }
}

TEST(GridFusionTest, ConflictIsUnknownWhereNoTwoKnow) {
  EXPECT_EQ(conflict({{80}}), kUnknownPercent);
  EXPECT_EQ(conflict({{80}, {kUnknownPercent}}), kUnknownPercent);
  EXPECT_EQ(conflict({{kUnknownPercent}, {kUnknownPercent}}), kUnknownPercent);
}

TEST(GridFusionTest, AThirdSourceWithoutInformationChangesNothing) {
  for (const FusionRule rule : kAllRules) {
    const FusedGrids two = fuse(rule, {{80}, {30, source(1, 0.3, 0.7)}});
    const FusedGrids three = fuse(rule, {{80}, {kUnknownPercent}, {30, source(1, 0.3, 0.7)}});
    EXPECT_EQ(two.fused.cells(), three.fused.cells());
    EXPECT_EQ(two.conflict.cells(), three.conflict.cells());
  }
}

TEST(GridFusionTest, WeightedSumIsTheMeanOfThoseThatKnow) {
  EXPECT_EQ(fused(FusionRule::kWeightedSum, {{80}, {20}}), 50);
  EXPECT_EQ(fused(FusionRule::kWeightedSum, {{80, source(0, 0.25)}, {20, source(0, 0.75)}}), 35);
  // Weights need not sum to 1.
  EXPECT_EQ(fused(FusionRule::kWeightedSum, {{80, source(0, 0.1)}, {20, source(0, 0.3)}}), 35);
  EXPECT_EQ(fused(FusionRule::kWeightedSum, {{90}, {20}, {10}}), 40);
}

TEST(GridFusionTest, TheHighestPriorityThatKnowsTheCellDecides) {
  EXPECT_EQ(fused(FusionRule::kPriority, {{80, source(0)}, {20, source(1)}}), 20);
  EXPECT_EQ(fused(FusionRule::kPriority, {{80, source(1)}, {20, source(0)}}), 80);
  // Vision covered it but could not decide: it still decides (eq. 3.2.6).
  EXPECT_EQ(fused(FusionRule::kPriority, {{80, source(0)}, {50, source(1)}}), 50);
  EXPECT_EQ(fused(FusionRule::kPriority,
                  {{10, source(0)}, {kUnknownPercent, source(2)}, {90, source(1)}}),
            90);
  // Of equal ones the first.
  EXPECT_EQ(fused(FusionRule::kPriority, {{80}, {20}}), 80);
}

TEST(GridFusionTest, MaximumIsTheMostOccupied) {
  EXPECT_EQ(fused(FusionRule::kMaximum, {{20}, {80}}), 80);
  EXPECT_EQ(fused(FusionRule::kMaximum, {{20}, {0}, {10}}), 20);
}

TEST(GridFusionTest, LogOddsOfIndependentSourcesAdd) {
  // Odds of 4 squared.
  EXPECT_EQ(fused(FusionRule::kLogOdds, {{80}, {80}}), 94);  // 16 / 17
  EXPECT_EQ(fused(FusionRule::kLogOdds, {{80}, {20}}), 50);
  EXPECT_EQ(fused(FusionRule::kLogOdds, {{80}, {50}}), 80);
  EXPECT_EQ(fused(FusionRule::kLogOdds, {{20}, {20}, {20}}), 2);  // 1 / 65
  // Reliability draws 80 percent to 65: odds of 13 / 7 times 1 / 4.
  EXPECT_EQ(fused(FusionRule::kLogOdds, {{80, source(0, 0.5, 0.5)}, {20}}), 32);
}

TEST(GridFusionTest, DempsterShaferAsComputedByHand) {
  // Both 0.6 occupied, 0.4 open: 0.84 occupied, 0.16 open.
  EXPECT_EQ(fused(FusionRule::kDempsterShafer, {{80}, {80}}), 92);
  // 0.6 occupied against 0.6 free: 0.24, 0.24 and 0.16 open of 0.64.
  EXPECT_EQ(fused(FusionRule::kDempsterShafer, {{80}, {20}}), 50);
  // Discounted to 0.48 against 0.54: 0.2208 occupied, 0.2808 free, 0.2392 open of 0.7408.
  EXPECT_EQ(
      fused(FusionRule::kDempsterShafer, {{80, source(0, 0.5, 0.8)}, {20, source(0, 0.5, 0.9)}}),
      46);
  EXPECT_EQ(conflict({{80, source(0, 0.5, 0.8)}, {20, source(0, 0.5, 0.9)}}), 26);
  // A source that reports 50 brings no evidence.
  EXPECT_EQ(fused(FusionRule::kDempsterShafer, {{73}, {50}}), 73);
  // Three: open 0.4^3, never in conflict, so 1 - 0.032.
  EXPECT_EQ(fused(FusionRule::kDempsterShafer, {{80}, {80}, {80}}), 97);
}

TEST(GridFusionTest, CertainSourcesThatContradictEachOtherLeaveTheCellUndecided) {
  EXPECT_EQ(fused(FusionRule::kDempsterShafer, {{100}, {0}}), 50);
  EXPECT_EQ(fused(FusionRule::kLogOdds, {{100}, {0}}), 50);
  EXPECT_EQ(conflict({{100}, {0}}), 100);
}

TEST(GridFusionTest, CertainSourcesThatAgreeStayCertain) {
  EXPECT_EQ(fused(FusionRule::kDempsterShafer, {{100}, {100}}), 100);
  EXPECT_EQ(fused(FusionRule::kLogOdds, {{100}, {100}}), 100);
  EXPECT_EQ(fused(FusionRule::kDempsterShafer, {{0}, {0}}), 0);
  EXPECT_EQ(fused(FusionRule::kLogOdds, {{0}, {0}}), 0);
}

TEST(GridFusionTest, ConflictIsTheContradictoryEvidence) {
  EXPECT_EQ(conflict({{80}, {20}}), 36);
  EXPECT_EQ(conflict({{80}, {80}}), 0);
  EXPECT_EQ(conflict({{20}, {0}}), 0);
  EXPECT_EQ(conflict({{50}, {100}}), 0);
  // 1 - (0.84 + 0.16 open) agrees; against 0.6 free: 0.84 * 0.6.
  EXPECT_EQ(conflict({{80}, {80}, {20}}), 50);
}

TEST(GridFusionTest, ConflictIsTheSameForEachRule) {
  for (const FusionRule rule : kAllRules) {
    EXPECT_EQ(fuse(rule, {{90, source(0, 0.3, 0.6)}, {15}}).conflict.cells(),
              fuse(FusionRule::kMaximum, {{90, source(0, 0.3, 0.6)}, {15}}).conflict.cells());
  }
}

TEST(GridFusionTest, AnUnreliableSourceBringsNoEvidence) {
  for (const FusionRule rule : {FusionRule::kLogOdds, FusionRule::kDempsterShafer}) {
    EXPECT_EQ(fused(rule, {{90}, {0, source(0, 0.5, 0.0)}}), 90);
  }
  EXPECT_EQ(conflict({{100}, {0, source(0, 0.5, 0.0)}}), 0);
}

TEST(GridFusionTest, OrderMattersToNoRule) {
  for (const FusionRule rule : kAllRules) {
    for (int a = 0; a <= 100; ++a) {
      for (int b = 0; b <= 100; ++b) {
        const Said first{static_cast<Percent>(a), source(0, 0.3, 0.8)};
        const Said second{static_cast<Percent>(b), source(1, 0.6, 0.9)};
        const FusedGrids forth = fuse(rule, {first, second});
        const FusedGrids back = fuse(rule, {second, first});
        ASSERT_EQ(forth.fused.cells(), back.fused.cells()) << a << ", " << b;
        ASSERT_EQ(forth.conflict.cells(), back.conflict.cells()) << a << ", " << b;
      }
    }
  }
}

TEST(GridFusionTest, EveryPairGivesAPercentAndEvidenceRulesAgreeOnTheSide) {
  for (int a = 0; a <= 100; ++a) {
    for (int b = 0; b <= 100; ++b) {
      const std::vector<Said> words = {{static_cast<Percent>(a)}, {static_cast<Percent>(b)}};
      for (const FusionRule rule : kAllRules) {
        const FusedGrids grids = fuse(rule, words);
        for (const SensorGrid* grid : {&grids.fused, &grids.conflict}) {
          ASSERT_GE(grid->at({0, 0}), 0);
          ASSERT_LE(grid->at({0, 0}), 100);
        }
        if (rule == FusionRule::kLogOdds || rule == FusionRule::kDempsterShafer) {
          const int percent = grids.fused.at({0, 0});
          ASSERT_TRUE(a + b < 100 ? percent <= 50 : a + b == 100 ? percent == 50 : percent >= 50);
        }
      }
    }
  }
}

TEST(GridFusionTest, InvalidPercentsDoNoHarm) {
  for (const FusionRule rule : kAllRules) {
    const int percent = fused(rule, {{std::numeric_limits<Percent>::max()}, {80}});
    EXPECT_GT(percent, 50);
    EXPECT_EQ(fused(rule, {{std::numeric_limits<Percent>::min()}, {80}}), 80);
  }
}

TEST(GridFusionTest, TheResultHasTheFirstOnesStampAndWindow) {
  const GridWindow window{0.5, 3, 2, {-1, -1}};
  const SensorGrid first(Stamp{5}, window);
  const SensorGrid second(Stamp{6}, window);
  const FusedGrids grids =
      fuseGrids(FusionRule::kPriority, {{&first, source(0)}, {&second, source(1)}});
  for (const SensorGrid* grid : {&grids.fused, &grids.conflict}) {
    EXPECT_EQ(grid->stamp(), Stamp{5});
    EXPECT_EQ(grid->window(), window);
  }
}

TEST(GridFusionTest, CellsDoNotMix) {
  const GridWindow window{0.3, 40, 30, {-20, -15}};
  SensorGrid first(Stamp{}, window);
  SensorGrid second(Stamp{}, window);
  Random random(5);
  for (SensorGrid* grid : {&first, &second}) {
    for (Percent& cell : grid->cells()) {
      cell = static_cast<Percent>(random.uniform(-1.0, 101.0));
    }
  }
  for (const FusionRule rule : kAllRules) {
    const FusedGrids grids = fuseGrids(rule, {{&first, source(0)}, {&second, source(1)}});
    first.forEach([&](CellIndex cell, Percent percent) {
      ASSERT_EQ(grids.fused.at(cell),
                fused(rule, {{percent, source(0)}, {second.at(cell), source(1)}}));
    });
  }
}

TEST(GridFusionTest, RefusesNoGridsAndGridsOfSeveralWindows) {
  EXPECT_THROW(fuseGrids(FusionRule::kMaximum, {}), std::invalid_argument);
  const SensorGrid first(Stamp{}, {1.0, 2, 2, {0, 0}});
  const SensorGrid second(Stamp{}, {1.0, 2, 2, {0, 1}});
  EXPECT_THROW(fuseGrids(FusionRule::kMaximum, {{&first, source()}, {&second, source()}}),
               std::invalid_argument);
}

}  // namespace
}  // namespace datmo::grid_fusion_test
