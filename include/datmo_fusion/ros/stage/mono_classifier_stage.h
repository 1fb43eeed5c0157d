// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
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
  FrameOptions frames;        ///< of all stages
  MotionOptions motion;       ///< of all stages
  double tolerance = 0.06;    ///< s
  double max_wait = 0.15;     ///< s
  double max_age = 0.5;       ///< s
  double object_speed = 3.0;  ///< m/s
  int detector_threads = 1;
  int detector_nice = 10;
  ExposureCheckOptions exposure;
  StreamOptions input;
  MonoClassifierOptions classifier;

  void visit(OptionVisitor& visitor);
};

/// MonoClassifier between messages: one more source of objects. The same one serves the nodelet,
/// where the detector has a thread of its own and looks at the newest image alone, and the bag
/// runner, where each image is looked at when it comes.
///
/// An image waits for objects of its time (`tolerance`), which are brought to the exposure by the
/// vehicle's motion; without any, or without that motion, it is looked at by itself. What is found
/// has the exposure's stamp, however long it took.
///
/// Bad input is dropped through the monitor, never thrown: what CameraInput and grayOrColor refuse,
/// `blank_image` (black, white), `half_image` (cut), `frozen_image` (the same pixels again),
/// `old_image` (older than the newest objects by more than `max_age`), `superseded_image` (a newer
/// one came before objects of its time), `slow_detector` (a newer one came before the detector had
/// time), `missing_transform`. When the clock jumps back all objects are forgotten. A detector that
/// is right no more often than by chance is warned of (`detector_tells_nothing`).
class MonoClassifierStage : public Stage {
 public:
  using Options = MonoClassifierStageOptions;

  /// `clock`: none: without a thread, and the output depends on nothing but the input. `transforms`
  /// and `monitor` must outlive the stage. Throws OptionError; also for a model that cannot be
  /// used.
  MonoClassifierStage(const Checked<MonoClassifierStageOptions>& options,
                      const TransformBuffer& transforms, StageMonitor& monitor,
                      const StepClock& clock = {});

  /// With a detector of the caller's. Throws OptionError.
  MonoClassifierStage(const Checked<MonoClassifierStageOptions>& options,
                      const TransformBuffer& transforms, StageMonitor& monitor,
                      const StepClock& clock, std::unique_ptr<MonoClassifier> classifier);

  /// Of the rectified images; the newest one serves.
  void takeCameraInfo(const sensor_msgs::CameraInfo& message);
  void takeOdometry(const nav_msgs::Odometry& message) { takeMotion(message); }
  void takePose(const geometry_msgs::PoseWithCovarianceStamped& message) { takeMotion(message); }
  void takeObjects(const ObjectArray& message);

  /// `now`: ROS time.
  void takeImage(const sensor_msgs::ImageConstPtr& message, Stamp now);

  /// The next list that is ready, at its exposure's stamp; null if there is none. To be called
  /// until null, after each input and from time to time. `now`: ROS time.
  ObjectArrayPtr next(Stamp now);

  /// Blocks until the detector has nothing to do: for tests.
  void waitUntilIdle() { worker_.waitUntilIdle(); }

  void connect(StagePorts& ports) override;
  bool publishNext(Stamp now) override;
  double maxWait() const override { return options_.max_wait; }

 private:
  /// All that the detector's thread needs.
  struct Job {
    sensor_msgs::ImageConstPtr image;
    MountedCamera camera;
    ObjectList objects;     ///< base frame at the exposure, its stamp
    std::uint64_t run = 0;  ///< of the clock
  };
  struct Result {
    MonoClassification classification;
    double seconds = 0.0;
    std::uint64_t run = 0;
    std::string error;  ///< what went wrong; empty: nothing
  };

  template <typename Message>
  void takeMotion(const Message& message) {
    runner_.serve([&] { motion_.take(message); });
  }

  void checkAge(const sensor_msgs::Image& image) const;
  void startIfReady(Stamp now);
  ObjectList objectsAt(Stamp exposure) const;
  static Result work(MonoClassifier& classifier, const Job& job);
  ObjectArrayPtr show(const Result& result);
  void reset();

  MonoClassifierStageOptions options_;
  const TransformBuffer& transforms_;
  StageMonitor& monitor_;
  StageRunner runner_;
  MotionInput motion_;
  CameraInput camera_;
  ExposureCheck exposure_;
  ImageWait<ObjectList> wait_;
  std::uint64_t run_ = 0;  ///< counts how often the clock started over
  std::deque<Result> results_;
  std::unique_ptr<MonoClassifier> classifier_;
  NewestWorker<Job, Result> worker_;  ///< last: its thread uses the classifier
  StagePublisher<ObjectArray> published_;
};

}  // namespace datmo
