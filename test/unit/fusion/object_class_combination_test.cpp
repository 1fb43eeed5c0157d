// SPDX-License-Identifier: BSD-3-Clause
// The class of an object that two sensors see.
#include <gtest/gtest.h>

#include "datmo_fusion/common/class_belief.h"
#include "datmo_fusion/fusion/object/object_combination.h"

namespace datmo::object_class_combination_test {
namespace {

Object reported(const ClassProbabilities& probabilities) {
  Object object;
  object.box = {Pose2(10.0, 0.0, 0.0), 1.0, 1.0};
  object.class_probabilities = probabilities;
  return object;
}

double vehicleIn(const ClassProbabilities& a, const ClassProbabilities& b) {
  const Object one = combined(reported(a), reported(b));
  const Object other = combined(reported(b), reported(a));
  EXPECT_EQ(one.class_probabilities, other.class_probabilities);
  return probabilityOf(ObjectClass::kVehicle, one.class_probabilities);
}

TEST(ObjectClassCombination, IsByBayes) {
  const ClassProbabilities vehicle = reportedClass(ObjectClass::kVehicle, 0.7);
  EXPECT_EQ(combined(reported({}), reported(vehicle)).class_probabilities, vehicle);
  EXPECT_GT(vehicleIn(reportedClass(ObjectClass::kVehicle, 0.6), vehicle), 0.8);
  const double doubted = vehicleIn(reportedClass(ObjectClass::kPedestrian, 0.4), vehicle);
  EXPECT_GT(doubted, 0.5);
  EXPECT_LT(doubted, 0.7);
}

TEST(ObjectClassCombination, OfContradictionsIsEitherOfThem) {
  const ClassProbabilities pedestrian = reportedClass(ObjectClass::kPedestrian, 0.9);
  EXPECT_NEAR(vehicleIn(pedestrian, reportedClass(ObjectClass::kVehicle, 0.9)), 0.47, 0.01);
}

TEST(ObjectClassCombination, SomethingElseTellsNothing) {
  const ClassProbabilities other = {0.8, 0.1, 0.0, 0.1, 0.0};
  const ClassProbabilities vehicle = reportedClass(ObjectClass::kVehicle, 0.7);
  EXPECT_EQ(combined(reported(other), reported(vehicle)).class_probabilities, vehicle);
  EXPECT_EQ(vehicleIn(other, {}), 0.0);
}

}  // namespace
}  // namespace datmo::object_class_combination_test
