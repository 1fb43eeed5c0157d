// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/stage/mono_classifier_stage.h"

#include <algorithm>
#include <functional>
#include <memory>
#include <stdexcept>
#include <utility>

#include "monitor_counts.h"
#include "mono_classifier_case.h"
#include <gtest/gtest.h>

namespace datmo::mono_classifier_stage_test {
namespace {

using mono_classifier_case::cameraInfo;
using mono_classifier_case::imageAt;
using mono_classifier_case::kCamera;
using mono_classifier_case::kStart;
using mono_classifier_case::MonoClassifierStageTest;
using mono_classifier_case::objectsAt;
using samples::drops;
using samples::warnings;

TEST_F(MonoClassifierStageTest, ClassifiesTheScannersObjects) {
  mountCamera();
  stage_->handleCameraInfo(cameraInfo());
  stage_->handleObjects(objectsAt(kStart));
  const auto found = look(imageAt(kStart));
  ASSERT_TRUE(found);
  ASSERT_NE(found->classes, nullptr);
  EXPECT_EQ(found->classes->header.stamp, ros::Time(kStart));
  EXPECT_EQ(found->classes->header.frame_id, "base_link");
  ASSERT_EQ(found->classes->objects.size(), 1U);
  EXPECT_EQ(found->classes->objects[0].classification, ObjectMessage::CLASS_PEDESTRIAN);
  EXPECT_EQ(found->classes->objects[0].pose.position.x, 10.2);
  EXPECT_EQ(found->alone->header.stamp, ros::Time(kStart));
  EXPECT_EQ(found->alone->header.frame_id, "base_link");
  EXPECT_TRUE(found->alone->objects.empty());
  EXPECT_EQ(monitor_.processedCount(), 1U);
}

/// Driven on between the scan and the exposure: the classes are those of the list as it was.
TEST_F(MonoClassifierStageTest, ClassesHaveTheStampAndThePositionsOfTheList) {
  constexpr double kLater = 0.05;  // s
  mountCamera();
  stage_->handleCameraInfo(cameraInfo());
  stage_->handleOdometry(samples::odometry(kStart - kLater, 10.0));
  stage_->handleOdometry(samples::odometry(kStart, 10.0));
  ObjectArray objects = objectsAt(kStart - kLater);
  objects.objects[0].pose.position.x += 10.0 * kLater;
  stage_->handleObjects(objects);
  const auto found = look(imageAt(kStart));
  ASSERT_TRUE(found);
  ASSERT_NE(found->classes, nullptr);
  EXPECT_EQ(found->classes->header.stamp, ros::Time(kStart - kLater));
  ASSERT_EQ(found->classes->objects.size(), 1U);
  EXPECT_EQ(found->classes->objects[0].pose.position.x, objects.objects[0].pose.position.x);
  EXPECT_EQ(found->alone->header.stamp, ros::Time(kStart));
}

TEST_F(MonoClassifierStageTest, OfSeveralImagesTheFirstClassifiesAList) {
  mountCamera();
  stage_->handleCameraInfo(cameraInfo());
  stage_->handleOdometry(samples::odometry(kStart, 0.0));
  stage_->handleOdometry(samples::odometry(kStart + 0.1, 0.0));
  stage_->handleObjects(objectsAt(kStart));
  const auto first = look(imageAt(kStart));
  const auto second = look(imageAt(kStart + 0.03));
  ASSERT_TRUE(first && second);
  EXPECT_NE(first->classes, nullptr);
  EXPECT_EQ(second->classes, nullptr);
  EXPECT_TRUE(second->alone->objects.empty());
}

TEST_F(MonoClassifierStageTest, ThereIsAWarningOfADetectorWithoutWeight) {
  mountCamera();
  stage_->handleCameraInfo(cameraInfo());
  EXPECT_TRUE(look(imageAt(kStart), 1.0));
  EXPECT_EQ(warnings(monitor_, "detector_tells_nothing"), 0U);
  MonoClassifierStage by_default(MonoClassifierStageOptions(), transforms_, monitor_);
  by_default.handleCameraInfo(cameraInfo());
  by_default.handleImage(imageAt(kStart), Stamp::fromSeconds(kStart));
  EXPECT_EQ(warnings(monitor_, "detector_tells_nothing"), 1U);
}

TEST_F(MonoClassifierStageTest, AnImageWaitsForObjectsOfItsTime) {
  mountCamera();
  stage_->handleCameraInfo(cameraInfo());
  EXPECT_FALSE(look(imageAt(kStart)));
  stage_->handleObjects(objectsAt(kStart));
  const auto named = stage_->next(Stamp::fromSeconds(kStart + 0.01));
  ASSERT_TRUE(named);
  ASSERT_NE(named->classes, nullptr);
  EXPECT_EQ(named->classes->objects.size(), 1U);
}

TEST_F(MonoClassifierStageTest, WithoutObjectsTheImageIsUsedAlone) {
  mountCamera();
  stage_->handleCameraInfo(cameraInfo());
  const auto found = look(imageAt(kStart), 1.0);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->classes, nullptr);
  ASSERT_EQ(found->alone->objects.size(), 1U);
  EXPECT_EQ(found->alone->objects[0].sensors, std::vector<std::string>{"mono"});
}

TEST_F(MonoClassifierStageTest, WithoutMotionObjectsOfAnotherTimeAreNotUsed) {
  mountCamera();
  stage_->handleCameraInfo(cameraInfo());
  stage_->handleObjects(objectsAt(kStart - 0.05));
  const auto alone = look(imageAt(kStart));
  ASSERT_TRUE(alone);
  EXPECT_EQ(alone->classes, nullptr);
  EXPECT_EQ(warnings(monitor_, "no_motion"), 1U);
}

TEST_F(MonoClassifierStageTest, InASeparateThreadTheResultIsTheSame) {
  stage_ = makeStage([] { return 0.0; });
  mountCamera();
  stage_->handleCameraInfo(cameraInfo());
  stage_->handleObjects(objectsAt(kStart));
  stage_->handleImage(imageAt(kStart), Stamp::fromSeconds(kStart));
  const auto early = stage_->next(Stamp::fromSeconds(kStart));
  stage_->waitUntilIdle();
  const auto late = early ? early : stage_->next(Stamp::fromSeconds(kStart + 0.3));
  ASSERT_TRUE(late);
  ASSERT_NE(late->classes, nullptr);
  EXPECT_EQ(late->classes->header.stamp, ros::Time(kStart));
  EXPECT_EQ(late->classes->objects.size(), 1U);
}

TEST_F(MonoClassifierStageTest, APartialImageIsDroppedAndASaturatedSkyIsNot) {
  const auto filled = [](double seconds, std::uint32_t from, std::uint32_t to, int gray) {
    const auto image = imageAt(seconds);
    std::fill(image->data.begin() + from * image->step, image->data.begin() + to * image->step,
              static_cast<std::uint8_t>(gray));
    return image;
  };
  expectDropped(filled(kStart, kCamera.height / 2, kCamera.height, 128), "half_image");
  EXPECT_TRUE(look(filled(kStart + 0.2, 0, kCamera.height / 3, 255), 1.0));
}

TEST_F(MonoClassifierStageTest, OfWaitingImagesTheNewestIsKept) {
  mountCamera();
  stage_->handleCameraInfo(cameraInfo());
  EXPECT_FALSE(look(imageAt(kStart)));
  EXPECT_FALSE(look(imageAt(kStart + 0.05)));
  EXPECT_EQ(drops(monitor_, "superseded_image"), 1U);
  EXPECT_TRUE(stage_->next(Stamp::fromSeconds(kStart + 1.0)));
}

TEST_F(MonoClassifierStageTest, WithoutInfoOrMountImagesAreDropped) {
  EXPECT_FALSE(look(imageAt(kStart), 1.0));
  EXPECT_EQ(drops(monitor_, "missing_camera_info"), 1U);
  stage_->handleCameraInfo(cameraInfo());
  EXPECT_FALSE(look(imageAt(kStart), 1.0));
  EXPECT_EQ(drops(monitor_, "missing_transform"), 1U);
}

TEST_F(MonoClassifierStageTest, AnInfoOfZerosIsRefused) {
  sensor_msgs::CameraInfo zeros = cameraInfo();
  zeros.P.fill(0.0);
  stage_->handleCameraInfo(zeros);
  EXPECT_EQ(drops(monitor_, "bad_camera_info"), 1U);
}

TEST_F(MonoClassifierStageTest, AnInfoOfAnotherSizeIsRefused) {
  const auto image = imageAt(kStart);
  image->width = kCamera.width / 2;
  image->step = kCamera.width / 2;
  expectDropped(image, "wrong_size");
}

TEST_F(MonoClassifierStageTest, BlackAndWhiteImagesAreRefused) {
  for (const std::uint8_t gray : {std::uint8_t{0}, std::uint8_t{255}}) {
    monitor_ = StageMonitor("mono_classifier");
    stage_ = makeStage();
    const auto image = imageAt(kStart);
    image->data.assign(image->data.size(), gray);
    expectDropped(image, "blank_image");
  }
}

TEST_F(MonoClassifierStageTest, PartialImagesAndOtherEncodingsAreRefused) {
  const auto half = imageAt(kStart);
  half->data.resize(half->data.size() / 2);
  expectDropped(half, "bad_encoding");
  monitor_ = StageMonitor("mono_classifier");
  stage_ = makeStage();
  const auto other = imageAt(kStart);
  other->encoding = "no encoding";
  expectDropped(other, "bad_encoding");
}

TEST_F(MonoClassifierStageTest, AFrozenImageIsRefused) {
  mountCamera();
  stage_->handleCameraInfo(cameraInfo());
  const auto first = imageAt(kStart);
  EXPECT_TRUE(look(first, 1.0));
  const auto again = boost::make_shared<sensor_msgs::Image>(*first);
  again->header.stamp = ros::Time(kStart + 0.1);
  EXPECT_FALSE(look(again, 1.0));
  EXPECT_EQ(drops(monitor_, "frozen_image"), 1U);
}

TEST_F(MonoClassifierStageTest, AnOldImageIsRefused) {
  mountCamera();
  stage_->handleCameraInfo(cameraInfo());
  stage_->handleObjects(objectsAt(kStart + 0.7));
  EXPECT_FALSE(look(imageAt(kStart), 1.0));
  EXPECT_EQ(drops(monitor_, "old_image"), 1U);
}

TEST_F(MonoClassifierStageTest, AClockJumpBackStartsOver) {
  mountCamera();
  stage_->handleCameraInfo(cameraInfo());
  stage_->handleObjects(objectsAt(kStart));
  EXPECT_TRUE(look(imageAt(kStart)));
  EXPECT_TRUE(look(imageAt(kStart - 50.0), 1.0));
  EXPECT_EQ(warnings(monitor_, "clock_restart"), 1U);
}

TEST_F(MonoClassifierStageTest, ObjectsOfAnotherFrameAreRefused) {
  ObjectArray objects = objectsAt(kStart);
  objects.header.frame_id = "map";
  stage_->handleObjects(objects);
  EXPECT_EQ(drops(monitor_, "wrong_frame"), 1U);
}

TEST(MonoClassifierStageModel, AMissingOneStopsItWithAMessage) {
  TransformBuffer transforms(1.0);
  StageMonitor monitor("mono_classifier");
  MonoClassifierStageOptions options;
  options.classifier.detector = ImageDetectorKind::kDnn;
  options.classifier.dnn.model = "/nowhere/model.onnx";
  try {
    const MonoClassifierStage stage(options, transforms, monitor);
    FAIL() << "expected OptionError";
  } catch (const OptionError& error) {
    EXPECT_NE(std::string(error.what()).find("/nowhere/model.onnx"), std::string::npos);
  }
}

}  // namespace
}  // namespace datmo::mono_classifier_stage_test
