// SPDX-License-Identifier: BSD-3-Clause
// What a track says of its class before it has moved.
#include <algorithm>

#include <gtest/gtest.h>

#include "datmo_fusion/tracking/target.h"

namespace datmo::class_by_size_test {
namespace {

/// All sides of it are seen.
Object objectOf(double length, double width) {
  Object object;
  object.box = {Pose2(10.0, 2.0, 0.3), length, width};
  object.position_covariance = 0.01 * Eigen::Matrix2d::Identity();
  object.side_variance.fill(0.002);
  return object;
}

ObjectClass classOf(const Object& object) {
  const TargetOptions options;
  const ClassProbabilities belief =
      Target(object, 0, 1, options).track(options).class_probabilities;
  return static_cast<ObjectClass>(std::max_element(belief.begin(), belief.end()) - belief.begin());
}

TEST(ClassBySize, OfWhatNoDetectorHasClassifiedTheSizeTells) {
  EXPECT_EQ(classOf(objectOf(4.2, 1.75)), ObjectClass::kVehicle);
  EXPECT_EQ(classOf(objectOf(11.0, 2.5)), ObjectClass::kVehicle) << "a bus";
  EXPECT_EQ(classOf(objectOf(1.8, 0.6)), ObjectClass::kCyclist);
  EXPECT_EQ(classOf(objectOf(0.6, 0.5)), ObjectClass::kPedestrian);
}

TEST(ClassBySize, ADetectorsClassIsNotWeighedByTheSizeOnceMore) {
  const TargetOptions options;
  Object object = objectOf(4.2, 1.75);
  object.object_class = ObjectClass::kCyclist;
  object.class_probability = 0.6;
  ClassBelief said;
  said.update(object.object_class, object.class_probability);
  EXPECT_EQ(Target(object, 0, 1, options).track(options).class_probabilities, said.probabilities());
}

}  // namespace
}  // namespace datmo::class_by_size_test
