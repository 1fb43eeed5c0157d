// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>

#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <nav_msgs/Odometry.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>

#include "datmo_fusion/common/object.h"
#include "datmo_fusion/ros/convert/messages.h"
#include "datmo_fusion/ros/frame_options.h"
#include "datmo_fusion/ros/stage/camera_input.h"
#include "datmo_fusion/ros/stage/exposure_check.h"
#include "datmo_fusion/ros/stage/image_wait.h"
#include "datmo_fusion/ros/stage/motion_input.h"
#include "datmo_fusion/ros/stage/newest_worker.h"
#include "datmo_fusion/ros/stage/stage.h"
#include "datmo_fusion/ros/stage/stage_runner.h"
#include "datmo_fusion/ros/transform_buffer.h"
#include "datmo_fusion/tracking/step_budget.h"
#include "datmo_fusion/vision/mono_classifier.h"

namespace datmo {

struct MonoClassifierStageOptions {
  FrameOptions frames;      ///< shared by all stages
  MotionOptions motion;     ///< shared by all stages
  double tolerance = 0.06;  ///< s
  double max_wait = 0.15;   ///< s
  double max_age = 0.5;     ///< s
  /// m/s, 0 to 100: standard deviation of the objects' speed between their time and the exposure
  double object_speed = 3.0;
  int detector_threads = 1;
  int detector_nice = 10;
  ExposureCheckOptions exposure;
  StreamOptions input;
  MonoClassifierOptions classifier;

  void visit(OptionVisitor& visitor);
};

/// Result of an image.
struct MonoObjects {
  /// Objects of the scanner's list nearest to the exposure, as listed and at its stamp, with the
  /// classes that the image gives them; null if the image was processed alone, or an earlier one
  /// has classified this list: images of the same moment err alike.
  ObjectArrayPtr classes;
  ObjectArrayPtr alone;  ///< from the image alone, at the exposure's stamp
};

/// Runs MonoClassifier on messages: classes for the tracker, and one more source of objects. The
/// nodelet runs the detector in a separate thread on the newest image only; the bag runner
/// processes each image synchronously.
///
/// An image waits for objects of its time (`tolerance`), which are moved to the exposure by the
/// vehicle's motion; without objects or motion it is processed alone. Results have the stamps of
/// the objects and of the exposure, however long the detector took.
///
/// Bad input is dropped and reported to the monitor, never thrown: what CameraInput and grayOrColor
/// reject, `blank_image` (black, white), `half_image` (truncated), `frozen_image` (repeated
/// pixels), `old_image` (older than the newest objects by more than `max_age`), `superseded_image`
/// (a newer one came before objects of its time), `slow_detector` (a newer one came before the
/// detector was idle), `detector_failed` (it threw), `missing_transform`. Objects are forgotten
/// when the clock jumps. A detector that is no better than chance causes a warning
/// (`detector_tells_nothing`).
class MonoClassifierStage : public Stage {
 public:
  using Options = MonoClassifierStageOptions;

  /// `clock`: none: no thread, and the output depends on the input alone. `transforms` and
  /// `monitor` must outlive the stage. Throws OptionError, also for an unusable model.
  MonoClassifierStage(const Checked<MonoClassifierStageOptions>& options,
                      const TransformBuffer& transforms, StageMonitor& monitor,
                      const StepClock& clock = {});

  /// Uses the caller's detector. Throws OptionError.
  MonoClassifierStage(const Checked<MonoClassifierStageOptions>& options,
                      const TransformBuffer& transforms, StageMonitor& monitor,
                      const StepClock& clock, std::unique_ptr<MonoClassifier> classifier);

  /// Of the rectified images; the newest one is used.
  void handleCameraInfo(const sensor_msgs::CameraInfo& message);
  void handleOdometry(const nav_msgs::Odometry& message) { handleMotion(message); }
  void handlePose(const geometry_msgs::PoseWithCovarianceStamped& message) {
    handleMotion(message);
  }
  void handleObjects(const ObjectArray& message);

  /// `now`: ROS time.
  void handleImage(const sensor_msgs::ImageConstPtr& message, Stamp now);

  /// Returns the next result that is ready; none if there is none. Call it until none, after each
  /// input and periodically. `now`: ROS time.
  std::optional<MonoObjects> next(Stamp now);

  /// Blocks until the detector is idle; for tests.
  void waitUntilIdle() { worker_.waitUntilIdle(); }

  void connect(StagePorts& ports) override;
  bool publishNext(Stamp now) override;
  double maxWait() const override { return options_.max_wait; }

 private:
  using Listed = std::shared_ptr<const ObjectList>;

  /// Input of the detector's thread.
  struct Job {
    sensor_msgs::ImageConstPtr image;
    MountedCamera camera;
    Listed listed;          ///< the scanner's objects as listed; null: the image is processed alone
    ObjectList objects;     ///< the same, moved to the base frame at the exposure, its stamp
    std::uint64_t run = 0;  ///< number of the clock's run
  };
  struct Result {
    MonoClassification classification;
    Listed listed;  ///< of its job
    double seconds = 0.0;
    std::uint64_t run = 0;
    std::string error;  ///< error message; empty: none
  };

  template <typename Message>
  void handleMotion(const Message& message) {
    runner_.serve([&] { motion_.update(message); });
  }

  void checkAge(const sensor_msgs::Image& image) const;
  void startIfReady(Stamp now);
  /// Without objects if there is no list at this time, or the motion since then is unknown.
  Job jobOf(const sensor_msgs::ImageConstPtr& image) const;
  static Result work(MonoClassifier& classifier, const Job& job);
  MonoObjects show(const Result& result);
  void reset();

  MonoClassifierStageOptions options_;
  const TransformBuffer& transforms_;
  StageMonitor& monitor_;
  StageRunner runner_;
  MotionInput motion_;
  CameraInput camera_;
  ExposureCheck exposure_;
  ImageWait<Listed> wait_;
  std::uint64_t run_ = 0;  ///< number of clock restarts
  std::deque<Result> results_;
  std::optional<Stamp> classified_;  ///< of the last list with classes
  std::unique_ptr<MonoClassifier> classifier_;
  NewestWorker<Job, Result> worker_;  ///< last: its thread uses the classifier
  StagePublisher<ObjectArray> classes_;
  StagePublisher<ObjectArray> alone_;
};

}  // namespace datmo
