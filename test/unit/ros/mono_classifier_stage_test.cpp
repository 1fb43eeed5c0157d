// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/stage/mono_classifier_stage.h"

#include <algorithm>
#include <functional>
#include <future>
#include <memory>
#include <stdexcept>
#include <utility>

#include "camera_samples.h"
#include "monitor_counts.h"
#include "vision/image_samples.h"
#include <boost/make_shared.hpp>
#include <gtest/gtest.h>
#include <opencv2/core/utility.hpp>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include "datmo_fusion/ros/convert/message_conversion.h"

namespace datmo::mono_classifier_stage_test {
namespace {

using samples::drops;
using samples::warnings;

constexpr double kStart = 100.0;  // s

/// As test::levelCamera.
constexpr samples::CameraSample kCamera{1000, 400, 500.0};

sensor_msgs::CameraInfo cameraInfo() { return kCamera.info(); }

/// Stripes; of another gray each time.
sensor_msgs::ImagePtr imageAt(double seconds) {
  static std::uint8_t gray = 0;
  auto message = boost::make_shared<sensor_msgs::Image>(kCamera.image(seconds, ++gray));
  for (std::size_t i = 0; i < message->data.size(); i += 2) {
    message->data[i] = 255;
  }
  return message;
}

ObjectArray objectsAt(double seconds) {
  ObjectList list;
  list.stamp = Stamp::fromSeconds(seconds);
  list.objects = {test::objectAt(10.2, 0.0, 0.4, 0.4, 0.0)};
  return toMessage(list, "base_link");
}

/// A person 10 m ahead in each image.
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

  ObjectArrayPtr look(const sensor_msgs::ImageConstPtr& image, double waited = 0.0) {
    const Stamp stamp = toStamp(image->header.stamp);
    stage_->takeImage(image, stamp);
    return stage_->next(stamp + waited);
  }

  /// Whether an image like this is dropped for this reason, and the next good one is not.
  void expectDropped(const sensor_msgs::ImagePtr& image, const std::string& reason) {
    mountCamera();
    stage_->takeCameraInfo(cameraInfo());
    EXPECT_EQ(look(image, 1.0), nullptr) << reason;
    EXPECT_EQ(drops(monitor_, reason), 1U) << reason;
    EXPECT_NE(look(imageAt(kStart + 0.1), 1.0), nullptr);
  }

  TransformBuffer transforms_{1.0};
  StageMonitor monitor_{"mono_classifier"};
  std::unique_ptr<MonoClassifierStage> stage_ = makeStage();
};

TEST_F(MonoClassifierStageTest, NamesObjectsAtTheExposuresStamp) {
  mountCamera();
  stage_->takeCameraInfo(cameraInfo());
  stage_->takeObjects(objectsAt(kStart));
  const auto named = look(imageAt(kStart));
  ASSERT_NE(named, nullptr);
  EXPECT_EQ(named->header.stamp, ros::Time(kStart));
  EXPECT_EQ(named->header.frame_id, "base_link");
  ASSERT_EQ(named->objects.size(), 1U);
  EXPECT_EQ(named->objects[0].classification, ObjectMessage::CLASS_PEDESTRIAN);
  EXPECT_NEAR(named->objects[0].pose.position.x, 10.2, 1e-9);
  EXPECT_EQ(monitor_.processedCount(), 1U);
}

TEST_F(MonoClassifierStageTest, ADetectorWithoutWeightIsWarnedOf) {
  mountCamera();
  stage_->takeCameraInfo(cameraInfo());
  EXPECT_NE(look(imageAt(kStart), 1.0), nullptr);
  EXPECT_EQ(warnings(monitor_, "detector_tells_nothing"), 0U);
  MonoClassifierStage by_default(MonoClassifierStageOptions(), transforms_, monitor_);
  by_default.takeCameraInfo(cameraInfo());
  by_default.takeImage(imageAt(kStart), Stamp::fromSeconds(kStart));
  EXPECT_EQ(warnings(monitor_, "detector_tells_nothing"), 1U);
}

TEST_F(MonoClassifierStageTest, AnImageWaitsForObjectsOfItsTime) {
  mountCamera();
  stage_->takeCameraInfo(cameraInfo());
  EXPECT_EQ(look(imageAt(kStart)), nullptr);
  stage_->takeObjects(objectsAt(kStart));
  const auto named = stage_->next(Stamp::fromSeconds(kStart + 0.01));
  ASSERT_NE(named, nullptr);
  EXPECT_NEAR(named->objects.at(0).pose.position.x, 10.2, 1e-9);
}

TEST_F(MonoClassifierStageTest, WithoutObjectsTheImageIsLookedAtByItself) {
  mountCamera();
  stage_->takeCameraInfo(cameraInfo());
  const auto alone = look(imageAt(kStart), 1.0);
  ASSERT_NE(alone, nullptr);
  ASSERT_EQ(alone->objects.size(), 1U);
  EXPECT_EQ(alone->objects[0].sensors, std::vector<std::string>{"mono"});
}

TEST_F(MonoClassifierStageTest, WithoutMotionObjectsOfAnotherTimeAreNotUsed) {
  mountCamera();
  stage_->takeCameraInfo(cameraInfo());
  stage_->takeObjects(objectsAt(kStart - 0.05));
  EXPECT_NE(look(imageAt(kStart)), nullptr);
  EXPECT_EQ(warnings(monitor_, "no_motion"), 1U);
}

TEST_F(MonoClassifierStageTest, InAThreadOfItsOwnTheResultIsTheSame) {
  stage_ = makeStage([] { return 0.0; });
  mountCamera();
  stage_->takeCameraInfo(cameraInfo());
  stage_->takeObjects(objectsAt(kStart));
  stage_->takeImage(imageAt(kStart), Stamp::fromSeconds(kStart));
  const auto early = stage_->next(Stamp::fromSeconds(kStart));
  stage_->waitUntilIdle();
  const auto late = early ? early : stage_->next(Stamp::fromSeconds(kStart + 0.3));
  ASSERT_NE(late, nullptr);
  EXPECT_EQ(late->header.stamp, ros::Time(kStart));
  EXPECT_EQ(late->objects.size(), 1U);
}

/// Does what it is told in place of looking, and sees nothing.
class ToldDetector : public ImageDetector {
 public:
  explicit ToldDetector(std::function<void()> told) : told_(std::move(told)) {}

  std::vector<ImageDetection> detect(const cv::Mat& /*image*/,
                                     const std::vector<ImageRegion>& /*regions*/) override {
    told_();
    return {};
  }

 private:
  std::function<void()> told_;
};

TEST_F(MonoClassifierStageTest, TheDetectorGivesWayToAllOtherThreads) {
  const int threads_before = cv::getNumThreads();
  int nice = 0;
  stage_ = makeStage([] { return 0.0; }, std::make_unique<ToldDetector>([&] {
                       nice = getpriority(PRIO_PROCESS, static_cast<id_t>(syscall(SYS_gettid)));
                     }));
  mountCamera();
  stage_->takeCameraInfo(cameraInfo());
  look(imageAt(kStart), 1.0);
  stage_->waitUntilIdle();
  EXPECT_GE(nice, MonoClassifierStageOptions().detector_nice);
  EXPECT_LT(getpriority(PRIO_PROCESS, static_cast<id_t>(syscall(SYS_gettid))), nice)
      << "only that thread";
  EXPECT_EQ(cv::getNumThreads(), MonoClassifierStageOptions().detector_threads);
  cv::setNumThreads(threads_before);
}

TEST_F(MonoClassifierStageTest, ADetectorThatIsTooSlowIsNamed) {
  std::promise<void> waited_enough;
  const std::shared_future<void> released = waited_enough.get_future().share();
  stage_ = makeStage([] { return 0.0; },
                     std::make_unique<ToldDetector>([released] { released.wait(); }));
  mountCamera();
  stage_->takeCameraInfo(cameraInfo());
  for (int i = 0; i < 3; ++i) {
    stage_->takeObjects(objectsAt(kStart + 0.1 * i));
    look(imageAt(kStart + 0.1 * i));
  }
  EXPECT_GE(drops(monitor_, "slow_detector"), 1U) << "one is looked at, one waits";
  EXPECT_EQ(drops(monitor_, "superseded_image"), 0U);
  waited_enough.set_value();
  stage_->waitUntilIdle();
}

TEST_F(MonoClassifierStageTest, AHalfImageIsDroppedAndABurntOutSkyIsNot) {
  const auto filled = [](double seconds, std::uint32_t from, std::uint32_t to, int gray) {
    const auto image = imageAt(seconds);
    std::fill(image->data.begin() + from * image->step, image->data.begin() + to * image->step,
              static_cast<std::uint8_t>(gray));
    return image;
  };
  expectDropped(filled(kStart, kCamera.height / 2, kCamera.height, 128), "half_image");
  EXPECT_NE(look(filled(kStart + 0.2, 0, kCamera.height / 3, 255), 1.0), nullptr);
}

TEST_F(MonoClassifierStageTest, OfImagesThatWaitTheNewestStays) {
  mountCamera();
  stage_->takeCameraInfo(cameraInfo());
  EXPECT_EQ(look(imageAt(kStart)), nullptr);
  EXPECT_EQ(look(imageAt(kStart + 0.05)), nullptr);
  EXPECT_EQ(drops(monitor_, "superseded_image"), 1U);
  EXPECT_NE(stage_->next(Stamp::fromSeconds(kStart + 1.0)), nullptr);
}

TEST_F(MonoClassifierStageTest, WithoutInfoOrMountImagesAreDropped) {
  EXPECT_EQ(look(imageAt(kStart), 1.0), nullptr);
  EXPECT_EQ(drops(monitor_, "missing_camera_info"), 1U);
  stage_->takeCameraInfo(cameraInfo());
  EXPECT_EQ(look(imageAt(kStart), 1.0), nullptr);
  EXPECT_EQ(drops(monitor_, "missing_transform"), 1U);
}

TEST_F(MonoClassifierStageTest, AnInfoOfZerosIsRefused) {
  sensor_msgs::CameraInfo zeros = cameraInfo();
  zeros.P.fill(0.0);
  stage_->takeCameraInfo(zeros);
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

TEST_F(MonoClassifierStageTest, HalfImagesAndOtherEncodingsAreRefused) {
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
  stage_->takeCameraInfo(cameraInfo());
  const auto first = imageAt(kStart);
  EXPECT_NE(look(first, 1.0), nullptr);
  const auto again = boost::make_shared<sensor_msgs::Image>(*first);
  again->header.stamp = ros::Time(kStart + 0.1);
  EXPECT_EQ(look(again, 1.0), nullptr);
  EXPECT_EQ(drops(monitor_, "frozen_image"), 1U);
}

TEST_F(MonoClassifierStageTest, AnOldImageIsRefused) {
  mountCamera();
  stage_->takeCameraInfo(cameraInfo());
  stage_->takeObjects(objectsAt(kStart + 0.7));
  EXPECT_EQ(look(imageAt(kStart), 1.0), nullptr);
  EXPECT_EQ(drops(monitor_, "old_image"), 1U);
}

TEST_F(MonoClassifierStageTest, AClockThatJumpsBackBeginsAnew) {
  mountCamera();
  stage_->takeCameraInfo(cameraInfo());
  stage_->takeObjects(objectsAt(kStart));
  EXPECT_NE(look(imageAt(kStart)), nullptr);
  EXPECT_NE(look(imageAt(kStart - 50.0), 1.0), nullptr);
  EXPECT_EQ(warnings(monitor_, "clock_restart"), 1U);
}

TEST_F(MonoClassifierStageTest, ObjectsOfAnotherFrameAreRefused) {
  ObjectArray objects = objectsAt(kStart);
  objects.header.frame_id = "map";
  stage_->takeObjects(objects);
  EXPECT_EQ(drops(monitor_, "wrong_frame"), 1U);
}

TEST(MonoClassifierStageModel, OneThatIsMissingStopsItWithAMessage) {
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
