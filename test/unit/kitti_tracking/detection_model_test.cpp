// SPDX-License-Identifier: BSD-3-Clause
#include "kitti_tracking/detection_model.h"

#include "made_camera.h"
#include <gtest/gtest.h>

namespace datmo::kitti::detection_model_test {
namespace {

Detection detectionAt(double right, double ahead) {
  Detection detection;
  detection.score = 4.5;
  detection.box = boxAt(right, ahead);
  return detection;
}

TEST(DetectionModelTest, TheScoreIsTheLogarithmOfOdds) {
  DetectionModelOptions options;
  options.score_slope = 0.5;
  options.score_even = 2.5;
  const DetectionModel model(options);
  EXPECT_EQ(model.logOdds(2.5), 0.0);
  EXPECT_EQ(model.object(detectionAt(0.0, 20.0), madeCamera()).log_odds, 1.0);
}

TEST(DetectionModelTest, ErrorsAreLargerAlongTheLineOfSightAndFarAway) {
  DetectionModelOptions options;
  options.along_sigma = 0.1;
  options.along_per_meter = 0.01;
  options.across_sigma = 0.05;
  options.across_per_meter = 0.001;
  const DetectionModel model(options);
  const Object ahead = model.object(detectionAt(0.0, 20.0), madeCamera());
  EXPECT_NEAR(ahead.position_covariance(0, 0), 0.09, 1e-12) << "0.1 + 20 * 0.01, squared";
  EXPECT_NEAR(ahead.position_covariance(1, 1), 0.07 * 0.07, 1e-12);
  EXPECT_NEAR(ahead.position_covariance(0, 1), 0.0, 1e-12);
  const Object left_ahead = model.object(detectionAt(-20.0, 20.0), madeCamera());
  EXPECT_GT(left_ahead.position_covariance(0, 1), 0.01);
}

TEST(DetectionModelTest, SidesShareTheErrorOfTheSize) {
  DetectionModelOptions options;
  options.length_sigma = 0.2;
  options.width_sigma = 0.1;
  const Object object = DetectionModel(options).object(detectionAt(0.0, 20.0), madeCamera());
  EXPECT_NEAR(object.side_variance[0] + object.side_variance[1], 0.04, 1e-12);
  EXPECT_NEAR(object.side_variance[2] + object.side_variance[3], 0.01, 1e-12);
  EXPECT_EQ(object.height, 1.5);
}

TEST(DetectionModelTest, ClassesHaveTheirNames) {
  const DetectionModel model{DetectionModelOptions()};
  const auto classOf = [&](ObjectType type) {
    Detection detection = detectionAt(0.0, 20.0);
    detection.type = type;
    return model.object(detection, madeCamera()).objectClass();
  };
  EXPECT_EQ(classOf(ObjectType::kCar), ObjectClass::kVehicle);
  EXPECT_EQ(classOf(ObjectType::kPedestrian), ObjectClass::kPedestrian);
  EXPECT_EQ(classOf(ObjectType::kCyclist), ObjectClass::kCyclist);
  EXPECT_EQ(classOf(ObjectType::kMisc), ObjectClass::kUnknown);
}

TEST(DetectionModelTest, CoversTheImage) {
  DetectionModelOptions options;
  options.sure_range = 30.0;
  options.range = 60.0;
  const FieldOfView view = DetectionModel(options).view(madeCamera());
  EXPECT_NEAR(view.sensor_in_base.x(), 1.0, 1e-12);
  EXPECT_NEAR(view.max_bearing, std::atan(600.0 / 700.0), 1e-12);
  EXPECT_EQ(view.sure_range, 30.0);
  EXPECT_EQ(view.range, 60.0);
}

}  // namespace
}  // namespace datmo::kitti::detection_model_test
