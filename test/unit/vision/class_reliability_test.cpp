// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/vision/class_reliability.h"

#include <limits>
#include <numeric>

#include <gtest/gtest.h>

namespace datmo::class_reliability_test {
namespace {

ClassReliabilityOptions curve() {
  ClassReliabilityOptions options;
  options.scores = {0.2, 0.4, 0.8};
  options.right = {0.3, 0.5, 0.9};
  return options;
}

TEST(ClassReliability, TheCurveIsStraightBetweenItsPointsAndLevelBeyond) {
  const ClassReliability reliability(curve());
  EXPECT_NEAR(reliability.right(0.1), 0.3, 1e-12);
  EXPECT_NEAR(reliability.right(0.2), 0.3, 1e-12);
  EXPECT_NEAR(reliability.right(0.3), 0.4, 1e-12);
  EXPECT_NEAR(reliability.right(0.6), 0.7, 1e-12);
  EXPECT_NEAR(reliability.right(0.8), 0.9, 1e-12);
  EXPECT_NEAR(reliability.right(5.0), 0.9, 1e-12);
  EXPECT_NEAR(reliability.right(std::numeric_limits<double>::quiet_NaN()), 0.3, 1e-12);
}

TEST(ClassReliability, ErrorsAreDistributedAsMeasured) {
  ClassReliabilityOptions options = curve();
  options.mistaken = {1.0, 9.0, 3.0, 0.0, 0.0,   // pedestrian
                      0.0, 0.0, 0.0, 0.0, 0.0,   // cyclist: nothing was wrong
                      1.0, 1.0, 1.0, 1.0, 1.0};  // vehicle
  const ClassReliability reliability(options);
  const auto pedestrian = reliability.probabilities(ObjectClass::kPedestrian, 0.8);
  EXPECT_NEAR(pedestrian[0], 0.025, 1e-12);
  EXPECT_NEAR(pedestrian[1], 0.9, 1e-12);
  EXPECT_NEAR(pedestrian[2], 0.075, 1e-12);
  EXPECT_NEAR(pedestrian[3], 0.0, 1e-12);
  const auto cyclist = reliability.probabilities(ObjectClass::kCyclist, 0.4);
  EXPECT_NEAR(cyclist[2], 0.5, 1e-12);
  EXPECT_NEAR(cyclist[0], 0.125, 1e-12);
}

TEST(ClassReliability, NoBetterThanChanceIsUninformative) {
  ClassReliabilityOptions options = curve();
  options.right = {0.05, 0.2, 0.9};
  const ClassReliability reliability(options);
  const auto nothing = reliability.probabilities(ObjectClass::kPedestrian, 0.3);
  EXPECT_EQ(nothing, ClassBelief().probabilities());
  EXPECT_GT(reliability.probabilities(ObjectClass::kPedestrian, 0.8)[1], 0.89);
  EXPECT_TRUE(reliability.isInformative());
  options.right = {0.05, 0.1, 0.2};
  EXPECT_FALSE(ClassReliability(options).isInformative());
}

TEST(ClassReliability, ProbabilitiesSumToOne) {
  const ClassReliability reliability(curve());
  for (std::size_t i = 0; i < kObjectClasses; ++i) {
    const auto all = reliability.probabilities(static_cast<ObjectClass>(i), 0.5);
    EXPECT_NEAR(std::accumulate(all.begin(), all.end(), 0.0), 1.0, 1e-12) << i;
  }
  const auto nothing = reliability.probabilities(ObjectClass::kPole, 0.5);
  EXPECT_NEAR(nothing[0], nothing[3], 1e-12) << "no detector reports poles";
}

TEST(ClassReliability, RefusesInvalidCurves) {
  ClassReliabilityOptions options = curve();
  options.scores = {0.2, 0.2, 0.8};
  EXPECT_THROW(ClassReliability{options}, OptionError);
  options = curve();
  options.right.pop_back();
  EXPECT_THROW(ClassReliability{options}, OptionError);
  options = curve();
  options.right[0] = 1.1;
  EXPECT_THROW(ClassReliability{options}, OptionError);
  options = curve();
  options.mistaken.pop_back();
  EXPECT_THROW(ClassReliability{options}, OptionError);
}

}  // namespace
}  // namespace datmo::class_reliability_test
