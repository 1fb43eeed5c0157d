// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/tracking/motion_by_class.h"

#include <cmath>

#include <gtest/gtest.h>

#include "datmo_fusion/common/class_belief.h"

namespace datmo {
namespace {

ClassProbabilities reportedAs(ObjectClass object_class, double probability, int times) {
  ClassBelief belief;
  for (int i = 0; i < times; ++i) {
    belief.update(reportedClass(object_class, probability));
  }
  return belief.probabilities();
}

TEST(ClassLogRatio, IsUninformativeForUnknownClasses) {
  MotionByClassOptions uneven;
  uneven.pedestrian = 0.6;
  EXPECT_NEAR(classLogRatio(ClassBelief().probabilities(), uneven), 0.0, 1e-12);
}

TEST(ClassLogRatio, IsAsComputedByHand) {
  MotionByClassOptions even;
  even.other = even.vehicle = 0.5;
  even.pedestrian = 0.8;
  even.pole = 0.2;
  even.cyclist = 0.5;
  const ClassProbabilities mixed{0.0, 0.6, 0.0, 0.4, 0.0};
  EXPECT_NEAR(classLogRatio(mixed, even), std::log((0.48 + 0.2) / (0.12 + 0.2)), 1e-12);
}

TEST(ClassLogRatio, PersonLikeObjectsMostlyMoveAndPolesDoNot) {
  const MotionByClassOptions options;
  const auto ratio = [&](ObjectClass object_class, double probability, int times) {
    return classLogRatio(reportedAs(object_class, probability, times), options);
  };
  EXPECT_GT(ratio(ObjectClass::kPedestrian, 0.9, 5), 1.5);
  EXPECT_GT(ratio(ObjectClass::kCyclist, 0.9, 5), 1.5);
  EXPECT_NEAR(ratio(ObjectClass::kVehicle, 0.9, 5), 0.0, 0.1);
  EXPECT_LT(ratio(ObjectClass::kPole, 0.9, 5), -2.0);
  EXPECT_LT(ratio(ObjectClass::kPedestrian, 0.4, 1), ratio(ObjectClass::kPedestrian, 0.9, 1))
      << "by how sure the class is";
}

}  // namespace
}  // namespace datmo
