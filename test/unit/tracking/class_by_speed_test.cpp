#include "datmo_fusion/tracking/class_by_speed.h"

#include <numeric>

#include <gtest/gtest.h>

namespace datmo {
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
  EXPECT_GT(of(ObjectClass::kCyclist, result), 0.75);
  EXPECT_NEAR(std::accumulate(result.begin(), result.end(), 0.0), 1.0, 1e-12);
}

TEST(ClassBySpeed, WhatIsTooFastToRideDrives) {
  const ClassProbabilities said{0.02, 0.10, 0.60, 0.26, 0.02};
  const ClassProbabilities result = weighedBySpeed(said, 15.0, ClassBySpeedOptions());
  EXPECT_GT(of(ObjectClass::kVehicle, result), 0.8);
}

TEST(ClassBySpeed, NoClassBecomesImpossible) {
  const ClassProbabilities result = weighedBySpeed(kPerson, 100.0, ClassBySpeedOptions());
  EXPECT_GT(of(ObjectClass::kPedestrian, result), 0.0);
}

TEST(ClassBySpeed, OptionsAreChecked) {
  ClassBySpeedOptions options;
  options.spread = 0.0;
  EXPECT_THROW(checkOptions(options), OptionError);
}

}  // namespace
}  // namespace datmo
