// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/PointCloud2.h>

#include "datmo_fusion/detection/stereo_object_detector.h"
#include "datmo_fusion/ros/convert/messages.h"
#include "datmo_fusion/ros/shared_keys.h"
#include "datmo_fusion/ros/stage/stage.h"
#include "datmo_fusion/ros/stage/stage_runner.h"
#include "datmo_fusion/ros/stage/stereo_input.h"
#include "datmo_fusion/ros/stage/velocity_wait.h"
#include "datmo_fusion/ros/transform_buffer.h"
#include "datmo_fusion/vision/object_velocity.h"

namespace datmo {

struct StereoObjectsStageOptions : StereoInputOptions {
  StereoObjectDetectorOptions detector;
  ObjectVelocityOptions velocity;
  VelocityWaitOptions wait;

  void visit(OptionVisitor& visitor);
  static SharedKeys sharedKeys();
};

/// StereoObjectDetector between messages: the same one serves the nodelet and the bag runner. Bad
/// input is dropped through the monitor, never thrown. When the clock jumps back the road of the
/// last clouds is forgotten.
///
/// Points with velocity (velocity_conversion.h) of the cloud's stamp give the objects their
/// velocities; without, these are not known. Where somebody publishes them, the objects wait for
/// them (VelocityWait).
class StereoObjectsStage : public Stage {
 public:
  using Options = StereoObjectsStageOptions;

  /// `transforms` and `monitor` must outlive the stage. Throws OptionError.
  StereoObjectsStage(const Checked<StereoObjectsStageOptions>& options,
                     const TransformBuffer& transforms, StageMonitor& monitor);

  /// Of the right camera; the newest one serves.
  void takeCameraInfo(const sensor_msgs::CameraInfo& message);

  /// The newest one serves.
  void takeAlignment(const StereoAlignmentMessage& message);

  /// Points with velocity, in the vehicle's frame.
  void takeVelocities(const sensor_msgs::PointCloud2& message);

  /// Objects in the vehicle's frame at the cloud's stamp; null if the cloud was dropped, or its
  /// objects wait. If those of an earlier cloud do, and need not any more, they come first.
  ObjectArrayPtr takeCloud(const sensor_msgs::PointCloud2& message);

  /// The next objects that have waited; null if there are none. To be called until null, after each
  /// input and from time to time. `now`: ROS time.
  ObjectArrayPtr next(Stamp now);

  void connect(StagePorts& ports) override;
  bool publishNext(Stamp now) override;
  double maxWait() const override { return options_.wait.max_wait; }

 private:
  void reset();
  /// Throws InputError (`bad_camera`) for one that is not mounted as one that sees the road.
  StereoObjects objectsOf(const StereoCloud& cloud);
  ObjectArrayPtr finish(VelocityWait::Served served);
  void measure(const std::vector<PointVelocity>& points, std::vector<Object>& objects);
  void show(const StereoObjects& objects);

  StereoObjectsStageOptions options_;
  StageMonitor& monitor_;
  StageRunner runner_;
  StereoInput input_;
  StereoObjectDetector detector_;
  VelocityWait wait_;
  std::uint64_t bad_points_ = 0;  ///< with velocity, since the start
  StagePublisher<ObjectArray> published_;
};

}  // namespace datmo
