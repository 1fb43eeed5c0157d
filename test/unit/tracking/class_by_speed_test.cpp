// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/tracking/class_by_speed.h"

#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

namespace datmo::class_by_speed_test {
namespace {

constexpr ClassProbabilities kPerson{0.02, 0.65, 0.30, 0.02, 0.01};

double of(ObjectClass object_class, const ClassProbabilities& probabilities) {
  return probabilities[static_cast<std::size_t>(object_class)];
}

TEST(ClassBySpeed, WhoWalksStaysAPedestrian) {
  const ClassProbabilities result = weighedBySpeed(kPerson, 1.4, ClassBySpeedOptions());
  EXPECT_EQ(result, kPerson);
}

TEST(ClassBySpeed, WhoIsTooFastToWalkRides) {
  const ClassProbabilities result = weighedBySpeed(kPerson, 5.0, ClassBySpeedOptions());
  // 2.5 m/s too fast: exp(-3.125) of those who walk are as fast.
  EXPECT_NEAR(of(ObjectClass::kCyclist, result), 0.30 + 0.65 * (1.0 - std::exp(-3.125)), 1e-12);
  EXPECT_NEAR(std::accumulate(result.begin(), result.end(), 0.0), 1.0, 1e-12);
}

TEST(ClassBySpeed, WhatIsTooFastToRideDrives) {
  const ClassProbabilities said{0.02, 0.10, 0.60, 0.26, 0.02};
  const ClassProbabilities result = weighedBySpeed(said, 15.0, ClassBySpeedOptions());
  EXPECT_GT(of(ObjectClass::kVehicle, result), 0.8);
}

TEST(ClassBySpeed, OtherThingsStayWhatTheyAre) {
  const ClassProbabilities said{0.3, 0.0, 0.0, 0.1, 0.6};
  EXPECT_EQ(weighedBySpeed(said, 30.0, ClassBySpeedOptions()), said);
}

TEST(ClassBySpeed, OptionsAreChecked) {
  ClassBySpeedOptions options;
  options.spread = 0.0;
  EXPECT_THROW(checkOptions(options), OptionError);
}

}  // namespace
}  // namespace datmo::class_by_speed_test
