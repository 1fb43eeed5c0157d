// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "camera_samples.h"
#include "monitor_counts.h"
#include "vision/image_samples.h"
#include <boost/make_shared.hpp>
#include <gtest/gtest.h>

#include "datmo_fusion/ros/convert/message_conversion.h"
#include "datmo_fusion/ros/stage/mono_classifier_stage.h"

namespace datmo::mono_classifier_case {

inline constexpr double kStart = 100.0;  // s

/// As in test::levelCamera.
inline constexpr samples::CameraSample kCamera{1000, 400, 500.0};

inline sensor_msgs::CameraInfo cameraInfo() { return kCamera.info(); }

/// Stripes; a different gray each time.
inline sensor_msgs::ImagePtr imageAt(double seconds) {
  static std::uint8_t gray = 0;
  auto message = boost::make_shared<sensor_msgs::Image>(kCamera.image(seconds, ++gray));
  for (std::size_t i = 0; i < message->data.size(); i += 2) {
    message->data[i] = 255;
  }
  return message;
}

inline ObjectArray objectsAt(double seconds) {
  ObjectList list;
  list.stamp = Stamp::fromSeconds(seconds);
  list.objects = {test::objectAt(10.2, 0.0, 0.4, 0.4, 0.0)};
  return toMessage(list, "base_link");
}

/// Detects a person 10 m ahead in each image.
class MonoClassifierStageTest : public testing::Test {
 protected:
  static MonoClassifierStageOptions stageOptions() {
    MonoClassifierStageOptions options;
    options.classifier.detector = ImageDetectorKind::kDnn;
    options.classifier.dnn_reliability.scores = {0.0};
    options.classifier.dnn_reliability.right = {0.8};
    return options;
  }

  std::unique_ptr<MonoClassifierStage> makeStage(const StepClock& clock = {}) {
    return makeStage(clock, std::make_unique<test::FixedDetector>(std::vector<ImageDetection>{
                                test::detectionOf(ObjectClass::kPedestrian, 485, 190, 515, 275)}));
  }

  std::unique_ptr<MonoClassifierStage> makeStage(const StepClock& clock,
                                                 std::unique_ptr<ImageDetector> detector) {
    auto classifier =
        std::make_unique<MonoClassifier>(stageOptions().classifier, std::move(detector));
    return std::make_unique<MonoClassifierStage>(stageOptions(), transforms_, monitor_, clock,
                                                 std::move(classifier));
  }

  void mountCamera() {
    transforms_.addStatic(
        samples::transforms({samples::cameraMount("base_link", test::kCameraHeight)}));
  }

  std::optional<MonoObjects> look(const sensor_msgs::ImageConstPtr& image, double waited = 0.0) {
    const Stamp stamp = toStamp(image->header.stamp);
    stage_->handleImage(image, stamp);
    return stage_->next(stamp + waited);
  }

  /// Expects that an image like this is dropped for this reason, and the next good one is not.
  void expectDropped(const sensor_msgs::ImagePtr& image, const std::string& reason) {
    mountCamera();
    stage_->handleCameraInfo(cameraInfo());
    EXPECT_FALSE(look(image, 1.0)) << reason;
    EXPECT_EQ(samples::drops(monitor_, reason), 1U) << reason;
    EXPECT_TRUE(look(imageAt(kStart + 0.1), 1.0));
  }

  TransformBuffer transforms_{1.0};
  StageMonitor monitor_{"mono_classifier"};
  std::unique_ptr<MonoClassifierStage> stage_ = makeStage();
};

}  // namespace datmo::mono_classifier_case
