// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/road/scan_novelty.h"

#include <cmath>

#include <gtest/gtest.h>

namespace datmo::scan_novelty_test {
namespace {

TEST(ScanNoveltyTest, TheFirstScanIsAllNews) {
  ScanNovelty novelty{ScanNoveltyOptions()};
  EXPECT_EQ(novelty.update({3.0, 4.0}, 0.0), 1.0);
  EXPECT_EQ(novelty.update({3.0, 4.0}, 0.0), 0.0) << "the same scan again";
  novelty.reset();
  EXPECT_EQ(novelty.update({3.0, 4.0}, 0.0), 1.0);
}

TEST(ScanNoveltyTest, ByHand) {
  ScanNoveltyOptions options;
  options.correlation_length = 0.5;
  options.correlation_time = 4.0;
  ScanNovelty novelty(options);
  novelty.update({0.0, 0.0}, 0.0);
  // Correlation exp(-0.5 / 0.5 - 1 / 4).
  EXPECT_NEAR(novelty.update({0.3, 0.4}, 1.0), 1.0 - std::exp(-2.5), 1e-12);
}

TEST(ScanNoveltyTest, WhileWaitingTheNumberOfScansDoesNotMatter) {
  const auto inTwoSeconds = [](int scans) {
    ScanNovelty novelty{ScanNoveltyOptions()};
    novelty.update({0.0, 0.0}, 0.0);
    double sum = 0.0;
    for (int scan = 0; scan < scans; ++scan) {
      sum += novelty.update({0.0, 0.0}, 2.0 / scans);
    }
    return sum;
  };
  EXPECT_NEAR(inTwoSeconds(100), inTwoSeconds(20), 0.02);
  EXPECT_LT(inTwoSeconds(100), 0.5);
}

}  // namespace
}  // namespace datmo::scan_novelty_test
