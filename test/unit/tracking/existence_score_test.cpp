// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/tracking/existence_score.h"

#include <cmath>

#include <gtest/gtest.h>

namespace datmo::existence_score_test {
namespace {

constexpr double kDetection = 0.9;
constexpr double kDensity = 0.01;  // 1/m^2

class ExistenceScoreTest : public testing::Test {
 protected:
  /// An object that lies where the filter predicts it, with a density of 1/m^2.
  void detect(int times = 1, double log_odds = 0.0, double log_likelihood = 0.0) {
    for (int i = 0; i < times; ++i) {
      score_.detect(log_likelihood, kDetection, std::log(kDensity), log_odds, options_);
    }
  }

  ExistenceOptions options_;
  ExistenceScore score_{0.0, options_};
};

TEST_F(ExistenceScoreTest, ANewTargetHasItsPriorProbability) {
  EXPECT_NEAR(score_.probability(options_), options_.birth_probability, 1e-12);
}

TEST_F(ExistenceScoreTest, TheDetectorsOddsOfTheFirstObjectCount) {
  options_.min_score = -20.0;
  const ExistenceScore doubted(-4.0, options_);
  const double prior = std::log(options_.birth_probability / (1.0 - options_.birth_probability));
  EXPECT_NEAR(doubted.logOdds(options_), prior - 4.0, 1e-12);
}

TEST_F(ExistenceScoreTest, AddsUpLogLikelihoodRatios) {
  options_.scan_limit = 100.0;
  detect();
  const double one = std::log(kDetection / (kDensity + options_.clutter_density));
  EXPECT_NEAR(score_.score(), one, 1e-12);
  detect(1, 0.75);
  EXPECT_NEAR(score_.score(), 2.0 * one + 0.75, 1e-12);
  score_.miss(kDetection, options_);
  EXPECT_NEAR(score_.score(), 2.0 * one + 0.75 + std::log(1.0 - kDetection), 1e-12);
}

TEST_F(ExistenceScoreTest, OddsCombinePriorAndScore) {
  options_.scan_limit = 100.0;
  options_.birth_probability = 0.5;
  options_.clutter_density = 0.0;
  detect();
  EXPECT_NEAR(score_.probability(options_), 90.0 / 91.0, 1e-9);
  EXPECT_NEAR(score_.logOdds(options_), std::log(90.0), 1e-9);
}

TEST_F(ExistenceScoreTest, OneObjectCountsForALimitedAmount) {
  detect();
  EXPECT_DOUBLE_EQ(score_.score(), options_.scan_limit);
  detect(1, -20.0);
  EXPECT_DOUBLE_EQ(score_.score(), 0.0);
}

TEST_F(ExistenceScoreTest, AMissInAnUnobservedAreaCostsLittle) {
  detect(4);
  const double before = score_.score();
  ExistenceScore visible = score_;
  visible.miss(0.95, options_);
  score_.miss(0.02, options_);
  EXPECT_NEAR(score_.score(), before + std::log(0.98), 1e-12);
  EXPECT_NEAR(visible.score(), before + std::log(0.05), 1e-12);
}

TEST_F(ExistenceScoreTest, StaysWithinItsLimits) {
  detect(100);
  EXPECT_EQ(score_.score(), options_.max_score);
  for (int i = 0; i < 100; ++i) {
    score_.miss(0.5, options_);
  }
  EXPECT_EQ(score_.score(), options_.min_score);
  constexpr double kFarOff = -20.0;
  detect(1, 0.0, kFarOff);
  EXPECT_EQ(score_.score(), options_.min_score);
}

}  // namespace
}  // namespace datmo::existence_score_test
