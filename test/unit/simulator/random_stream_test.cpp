// SPDX-License-Identifier: BSD-3-Clause
#include "simulator/random_stream.h"

#include <cmath>

#include <gtest/gtest.h>

namespace datmo::simulator::random_stream_test {
namespace {

constexpr int kDraws = 100000;

TEST(RandomStream, SameSeedAndNameGiveTheSameNumbers) {
  RandomStream a(7, "scanner");
  RandomStream b(7, "scanner");
  for (int i = 0; i < 100; ++i) {
    EXPECT_EQ(a.uniform(), b.uniform());
    EXPECT_EQ(a.normal(1.0), b.normal(1.0));
  }
}

TEST(RandomStream, OtherNameOrSeedGivesOthers) {
  RandomStream stream(7, "scanner");
  RandomStream other_name(7, "camera");
  RandomStream other_seed(8, "scanner");
  const double first = stream.uniform();
  EXPECT_NE(first, other_name.uniform());
  EXPECT_NE(first, other_seed.uniform());
}

TEST(RandomStream, UniformFillsTheUnitInterval) {
  RandomStream stream(1, "test");
  double sum = 0.0;
  double square_sum = 0.0;
  for (int i = 0; i < kDraws; ++i) {
    const double value = stream.uniform();
    ASSERT_GE(value, 0.0);
    ASSERT_LT(value, 1.0);
    sum += value;
    square_sum += value * value;
  }
  EXPECT_NEAR(sum / kDraws, 0.5, 0.005);
  EXPECT_NEAR(square_sum / kDraws, 1.0 / 3.0, 0.005);
}

TEST(RandomStream, NormalHasItsSigmaAndItsTails) {
  RandomStream stream(1, "test");
  double sum = 0.0;
  double square_sum = 0.0;
  int beyond_two_sigma = 0;
  for (int i = 0; i < kDraws; ++i) {
    const double value = stream.normal(0.3);
    sum += value;
    square_sum += value * value;
    beyond_two_sigma += std::abs(value) > 0.6 ? 1 : 0;
  }
  EXPECT_NEAR(sum / kDraws, 0.0, 0.005);
  EXPECT_NEAR(std::sqrt(square_sum / kDraws), 0.3, 0.005);
  EXPECT_NEAR(static_cast<double>(beyond_two_sigma) / kDraws, 0.0455, 0.004);
}

TEST(RandomStream, ChanceHasItsProbability) {
  RandomStream stream(1, "test");
  int hits = 0;
  for (int i = 0; i < kDraws; ++i) {
    hits += stream.chance(0.2) ? 1 : 0;
    ASSERT_FALSE(stream.chance(0.0));
    ASSERT_TRUE(stream.chance(1.0));
  }
  EXPECT_NEAR(static_cast<double>(hits) / kDraws, 0.2, 0.005);
}

}  // namespace
}  // namespace datmo::simulator::random_stream_test
