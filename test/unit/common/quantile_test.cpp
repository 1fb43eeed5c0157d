// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/common/quantile.h"

#include <gtest/gtest.h>

namespace datmo::quantile_test {
namespace {

TEST(Quantile, IsTheNearestRank) {
  const std::vector<double> values = {5.0, 1.0, 4.0, 2.0, 3.0};
  EXPECT_DOUBLE_EQ(quantile(values, 0.5), 3.0);
  EXPECT_DOUBLE_EQ(quantile(values, 0.2), 1.0);
  EXPECT_DOUBLE_EQ(quantile(values, 0.21), 2.0);
}

TEST(Quantile, EndsAreTheMinimumAndTheMaximum) {
  const std::vector<double> values = {5.0, 1.0, 4.0};
  EXPECT_DOUBLE_EQ(quantile(values, 0.0), 1.0);
  EXPECT_DOUBLE_EQ(quantile(values, 1.0), 5.0);
}

TEST(Quantile, OfNoValuesIsZero) { EXPECT_DOUBLE_EQ(quantile({}, 0.5), 0.0); }

}  // namespace
}  // namespace datmo::quantile_test
