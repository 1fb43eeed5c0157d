// SPDX-License-Identifier: BSD-3-Clause
// Pedestrians, cyclists and vehicles each move in their own way.
#include <cmath>

#include "tracking_scene.h"
#include <gtest/gtest.h>

#include "datmo_fusion/common/class_belief.h"
#include "datmo_fusion/tracking/target.h"

namespace datmo::class_motion_test {
namespace {

double turnRateOf(ObjectClass object_class) {
  return ImmOptions().motionOf(object_class).turn_rate;
}

Object measurementIndex(ObjectClass object_class, double probability, const Point2& position) {
  Object object = objectAt(position.x(), position.y());
  object.class_probabilities = reportedClass(object_class, probability);
  return object;
}

TEST(ClassMotion, PeopleTurnFasterThanVehiclesAndUnknownClasses) {
  EXPECT_GT(turnRateOf(ObjectClass::kPedestrian), turnRateOf(ObjectClass::kCyclist));
  EXPECT_GT(turnRateOf(ObjectClass::kCyclist), turnRateOf(ObjectClass::kVehicle));
  EXPECT_EQ(turnRateOf(ObjectClass::kUnknown), turnRateOf(ObjectClass::kVehicle));
}

TEST(ClassMotion, TheStepsOfAScanAreThoseOfEachClass) {
  const ImmOptions options;
  const ImmSteps steps = immSteps(options, 0.1);
  const auto left = static_cast<std::size_t>(MotionMode::kLeftTurn);
  for (const ObjectClass object_class :
       {ObjectClass::kUnknown, ObjectClass::kPedestrian, ObjectClass::kCyclist,
        ObjectClass::kVehicle, ObjectClass::kPole}) {
    const LinearMotion& motion = steps[static_cast<std::size_t>(object_class)].motions[left];
    const TargetMotionOptions& expected = options.motionOf(object_class);
    EXPECT_TRUE(
        motion.transition.isApprox(coordinatedTurn(expected.turn_rate, expected, 0.1).transition));
  }
}

/// Mean error (m) of the position predicted for the next scan, for a pedestrian who walks in
/// circles.
double predictionErrorOf(ObjectClass object_class) {
  constexpr double kPeriod = 0.1;    // s
  constexpr double kSpeed = 1.3;     // m/s
  constexpr double kTurnRate = 0.8;  // rad/s
  constexpr int kScans = 200;
  const TargetOptions options;
  const ImmSteps steps = immSteps(options.filter, kPeriod);
  const auto positionAt = [&](int i) {
    const double angle = kTurnRate * kPeriod * i;
    return Point2(kSpeed / kTurnRate * Point2(std::cos(angle), std::sin(angle)));
  };
  Target target(measurementIndex(object_class, 0.9, positionAt(0)), 0, 1, options);
  double error = 0.0;
  for (int i = 1; i <= kScans; ++i) {
    target.predict(kPeriod, steps, options);
    error += (target.filter().estimate().mean.head<2>() - positionAt(i)).norm() / kScans;
    target.update({measurementIndex(object_class, 0.9, positionAt(i)), {0}}, 0, 0.9, options);
  }
  return error;
}

TEST(ClassMotion, WalkingInCirclesIsPredictedBetterAsAPedestrian) {
  EXPECT_LT(predictionErrorOf(ObjectClass::kPedestrian),
            0.9 * predictionErrorOf(ObjectClass::kVehicle));
}

}  // namespace
}  // namespace datmo::class_motion_test
