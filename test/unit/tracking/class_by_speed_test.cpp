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

TEST(ClassBySpeed, WalkingSpeedIsAPedestrian) {
  const ClassProbabilities result = withSpeed(kPerson, {1.4, 0.2}, ClassBySpeedOptions());
  EXPECT_GT(of(ObjectClass::kPedestrian, result), 0.9);
  EXPECT_NEAR(std::accumulate(result.begin(), result.end(), 0.0), 1.0, 1e-12);
}

TEST(ClassBySpeed, TooFastToWalkIsACyclist) {
  const ClassProbabilities result = withSpeed(kPerson, {5.0, 0.2}, ClassBySpeedOptions());
  EXPECT_GT(of(ObjectClass::kCyclist, result), 0.9);
}

TEST(ClassBySpeed, TooFastToRideIsAVehicle) {
  const ClassProbabilities said{0.02, 0.10, 0.60, 0.26, 0.02};
  const ClassProbabilities result = withSpeed(said, {10.0, 0.2}, ClassBySpeedOptions());
  EXPECT_GT(of(ObjectClass::kVehicle, result), 0.8);
}

TEST(ClassBySpeed, AClearCarStaysACarWhenItCreeps) {
  const ClassProbabilities said{0.01, 0.01, 0.01, 0.96, 0.01};
  for (const double speed : {0.5, 1.4, 5.0}) {
    const ClassProbabilities result = withSpeed(said, {speed, 0.3}, ClassBySpeedOptions());
    EXPECT_GT(of(ObjectClass::kVehicle, result), 0.7) << speed;
  }
}

TEST(ClassBySpeed, IsAsComputedByHand) {
  ClassBySpeedOptions options;
  options.pedestrian = {1.0, 0.3};
  options.cyclist = {4.0, 0.3};
  options.vehicle = {4.0, 0.3};
  // With 0.4 of deviation 0.5 in all: the pedestrian is 3 m/s off, 6 standard deviations.
  const double pedestrian = std::exp(-18.0);
  const ClassProbabilities result = withSpeed({0.0, 0.5, 0.25, 0.25, 0.0}, {4.0, 0.4}, options);
  EXPECT_NEAR(of(ObjectClass::kPedestrian, result), pedestrian / (1.0 + pedestrian), 1e-9);
  EXPECT_NEAR(of(ObjectClass::kCyclist, result), 0.5, 1e-6);
}

TEST(ClassBySpeed, OtherObjectsAreUnchanged) {
  const ClassProbabilities said{0.4, 0.0, 0.0, 0.0, 0.6};
  const ClassProbabilities result = withSpeed(said, {30.0, 1.0}, ClassBySpeedOptions());
  for (std::size_t i = 0; i < kObjectClasses; ++i) {
    EXPECT_NEAR(result[i], said[i], 1e-12);
  }
}

TEST(ClassBySpeed, AnUnknownSpeedIsUninformative) {
  const ClassProbabilities result = withSpeed(kPerson, {1.0, 1e3}, ClassBySpeedOptions());
  for (std::size_t i = 0; i < kObjectClasses; ++i) {
    EXPECT_NEAR(result[i], kPerson[i], 1e-3);
  }
}

TEST(ClassBySpeed, NoSpeedLeavesAnythingUndefined) {
  const ClassProbabilities surely{0.0, 1.0, 0.0, 0.0, 0.0};
  for (const ClassProbabilities& said : {kPerson, surely}) {
    const ClassProbabilities result = withSpeed(said, {1e3, 0.0}, ClassBySpeedOptions());
    EXPECT_NEAR(std::accumulate(result.begin(), result.end(), 0.0), 1.0, 1e-12);
  }
}

TEST(ClassBySpeed, EvidenceOfSpeedCanBeRemovedAgain) {
  for (const double speed : {0.0, 1.4, 5.0, 12.0, 60.0}) {
    const MeasuredSpeed measured{speed, 0.3};
    const ClassProbabilities weighed = withSpeed(kPerson, measured, ClassBySpeedOptions());
    const ClassProbabilities result = withoutSpeed(weighed, measured, ClassBySpeedOptions());
    for (std::size_t i = 0; i < kObjectClasses; ++i) {
      EXPECT_NEAR(result[i], kPerson[i], 1e-6) << speed;
    }
  }
}

TEST(ClassBySpeed, TheSpeedIsAsUncertainAsTheVelocityAlongItself) {
  StateEstimate estimate;
  estimate.mean.setZero();
  estimate.covariance.setZero();
  estimate.covariance(2, 2) = 4.0;
  estimate.covariance(3, 3) = 1.0;
  EXPECT_DOUBLE_EQ(speedOf(estimate).std, std::sqrt(2.5)) << "of any direction";
  estimate.mean[2] = 3.0;
  EXPECT_DOUBLE_EQ(speedOf(estimate).value, 3.0);
  EXPECT_DOUBLE_EQ(speedOf(estimate).std, 2.0);
}

TEST(ClassBySpeed, OptionsAreChecked) {
  ClassBySpeedOptions options;
  options.cyclist.std = 0.0;
  EXPECT_THROW(checkOptions(options), OptionError);
}

}  // namespace
}  // namespace datmo::class_by_speed_test
