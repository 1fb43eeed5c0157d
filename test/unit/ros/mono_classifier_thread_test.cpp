// SPDX-License-Identifier: BSD-3-Clause
// The detector thread of MonoClassifierStage.
#include <functional>
#include <future>
#include <memory>
#include <optional>
#include <stdexcept>
#include <utility>

#include "monitor_counts.h"
#include "mono_classifier_case.h"
#include <gtest/gtest.h>
#include <opencv2/core/utility.hpp>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace datmo::mono_classifier_thread_test {
namespace {

using mono_classifier_case::cameraInfo;
using mono_classifier_case::imageAt;
using mono_classifier_case::kStart;
using mono_classifier_case::objectsAt;
using samples::drops;

class MonoClassifierThread : public mono_classifier_case::MonoClassifierStageTest {
 protected:
  /// Returns the result when the detector has finished.
  std::optional<MonoObjects> lookAndWait(const sensor_msgs::ImageConstPtr& image) {
    const auto at_once = look(image, 1.0);
    stage_->waitUntilIdle();
    return at_once ? at_once : stage_->next(toStamp(image->header.stamp) + 1.0);
  }
};

/// Runs a given function instead of looking, and detects nothing.
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

TEST_F(MonoClassifierThread, TheDetectorYieldsToAllOtherThreads) {
  const int threads_before = cv::getNumThreads();
  int nice = 0;
  stage_ = makeStage([] { return 0.0; }, std::make_unique<ToldDetector>([&] {
                       nice = getpriority(PRIO_PROCESS, static_cast<id_t>(syscall(SYS_gettid)));
                     }));
  mountCamera();
  stage_->handleCameraInfo(cameraInfo());
  look(imageAt(kStart), 1.0);
  stage_->waitUntilIdle();
  EXPECT_GE(nice, MonoClassifierStageOptions().detector_nice);
  EXPECT_LT(getpriority(PRIO_PROCESS, static_cast<id_t>(syscall(SYS_gettid))), nice)
      << "only that thread";
  EXPECT_EQ(cv::getNumThreads(), MonoClassifierStageOptions().detector_threads);
  cv::setNumThreads(threads_before);
}

TEST_F(MonoClassifierThread, ADetectorThatIsTooSlowIsNamed) {
  std::promise<void> waited_enough;
  const std::shared_future<void> released = waited_enough.get_future().share();
  stage_ = makeStage([] { return 0.0; },
                     std::make_unique<ToldDetector>([released] { released.wait(); }));
  mountCamera();
  stage_->handleCameraInfo(cameraInfo());
  for (int i = 0; i < 3; ++i) {
    stage_->handleObjects(objectsAt(kStart + 0.1 * i));
    look(imageAt(kStart + 0.1 * i));
  }
  EXPECT_GE(drops(monitor_, "slow_detector"), 1U) << "one is looked at, one waits";
  EXPECT_EQ(drops(monitor_, "superseded_image"), 0U);
  waited_enough.set_value();
  stage_->waitUntilIdle();
}

TEST_F(MonoClassifierThread, ADetectorThatFailsOnceIsCountedAndTheNextImageWorks) {
  stage_ =
      makeStage([] { return 0.0; }, std::make_unique<ToldDetector>([is_first = true]() mutable {
                  if (std::exchange(is_first, false)) {
                    throw std::runtime_error("out of memory");
                  }
                }));
  mountCamera();
  stage_->handleCameraInfo(cameraInfo());
  EXPECT_FALSE(lookAndWait(imageAt(kStart)));
  EXPECT_EQ(drops(monitor_, "detector_failed"), 1U);
  EXPECT_EQ(monitor_.processedCount(), 0U);
  const auto next = lookAndWait(imageAt(kStart + 0.1));
  ASSERT_TRUE(next);
  EXPECT_EQ(next->alone->header.stamp, ros::Time(kStart + 0.1));
  EXPECT_EQ(drops(monitor_, "detector_failed"), 1U);
}

}  // namespace
}  // namespace datmo::mono_classifier_thread_test
