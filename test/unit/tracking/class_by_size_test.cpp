// SPDX-License-Identifier: BSD-3-Clause
// A track's class before it has moved.
#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "datmo_fusion/common/class_belief.h"
#include "datmo_fusion/tracking/association_scan.h"
#include "datmo_fusion/tracking/target.h"

namespace datmo::class_by_size_test {
namespace {

/// All sides of it are visible.
Object objectOf(double length, double width) {
  Object object;
  object.box = {Pose2(10.0, 2.0, 0.3), length, width};
  object.position_covariance = 0.01 * Eigen::Matrix2d::Identity();
  object.side_variance.fill(0.002);
  return object;
}

/// The same as reported by a sensor, with this class.
Object reportOf(double length, double width, const char* sensor, ObjectClass object_class,
                double probability) {
  Object object = objectOf(length, width);
  object.sensors = {sensor};
  object.class_probabilities = reportedClass(object_class, probability);
  return object;
}

ObjectClass classOf(const Target& target) {
  const ClassProbabilities belief = target.track(TargetOptions()).class_probabilities;
  return static_cast<ObjectClass>(std::max_element(belief.begin(), belief.end()) - belief.begin());
}

ObjectClass classOf(const Object& object) { return classOf(Target(object, 0, 1, TargetOptions())); }

/// Seen once, and again every tenth of a second.
class Seen {
 public:
  explicit Seen(const Object& object) : target_(object, 0, 1, options_) {}

  void again(const Object& object, int times = 1) {
    for (int i = 0; i < times; ++i) {
      target_.predict(kPeriod, immSteps(options_.filter, kPeriod), options_);
      target_.update({object, {}, kLogDensity}, 0, 0.9, options_);
    }
  }
  const Target& target() const { return target_; }

 private:
  static constexpr double kPeriod = 0.1;       // s
  static constexpr double kLogDensity = -5.0;  // of others, 1/m^2

  TargetOptions options_;
  Target target_;
};

TEST(ClassBySize, UnclassifiedObjectsAreClassifiedBySize) {
  EXPECT_EQ(classOf(objectOf(4.2, 1.75)), ObjectClass::kVehicle);
  EXPECT_EQ(classOf(objectOf(11.0, 2.5)), ObjectClass::kVehicle) << "a bus";
  EXPECT_EQ(classOf(objectOf(1.8, 0.6)), ObjectClass::kCyclist);
  EXPECT_EQ(classOf(objectOf(0.6, 0.5)), ObjectClass::kPedestrian);
}

TEST(ClassBySize, ADetectorsClassIsNotWeightedBySizeAgain) {
  const TargetOptions options;
  const Object object = reportOf(4.2, 1.75, "stereo", ObjectClass::kCyclist, 0.6);
  ClassBelief said;
  said.update(object.class_probabilities);
  EXPECT_EQ(Target(object, 0, 1, options).track(options).class_probabilities, said.probabilities());
}

TEST(ClassBySize, OneWeakImageReportDoesNotOverrideSizes) {
  Seen seen(objectOf(4.2, 1.75));
  seen.again(objectOf(4.2, 1.75), 50);
  seen.again(reportOf(4.2, 1.75, "lidar", ObjectClass::kPedestrian, 0.28));
  EXPECT_EQ(classOf(seen.target()), ObjectClass::kVehicle);
}

TEST(ClassBySize, ImageReportsWinOverASizeThatFitsAnotherClass) {
  Seen seen(objectOf(4.2, 1.75));  // people side by side
  seen.again(reportOf(4.2, 1.75, "lidar", ObjectClass::kPedestrian, 0.8), 10);
  EXPECT_EQ(classOf(seen.target()), ObjectClass::kPedestrian);
}

bool hasClassBySize(const std::vector<std::string>& sensors) {
  Object object = objectOf(4.2, 1.75);
  object.sensors = sensors;
  return TargetOptions().hasClassBySize(object);
}

TEST(ClassBySize, OneSensorThatClassifiesBySizeIsEnough) {
  EXPECT_FALSE(hasClassBySize({"lidar"}));
  EXPECT_FALSE(hasClassBySize({"mono", "radar"}));
  EXPECT_TRUE(hasClassBySize({"stereo", "mono"})) << "only stereo measures size";
  EXPECT_TRUE(hasClassBySize({"somebody's"}));
  EXPECT_TRUE(hasClassBySize({})) << "nobody knows";
}

TEST(ClassBySize, CountsAgainIfAnotherSensorMeasuredTheSizeAsWell) {
  EXPECT_FALSE(hasClassBySize({"lidar", "stereo"}));
}

}  // namespace
}  // namespace datmo::class_by_size_test
