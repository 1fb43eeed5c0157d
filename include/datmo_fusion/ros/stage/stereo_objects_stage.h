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

/// Runs StereoObjectDetector on messages, for both the nodelet and the bag runner. Bad input is
/// dropped and reported to the monitor, never thrown. When the clock jumps the road of the
/// last clouds is forgotten.
///
/// The objects get their velocities from points with velocity (velocity_conversion.h) at the
/// cloud's stamp; without these, velocities are unknown. If such points are published, the objects
/// wait for them (VelocityWait).
class StereoObjectsStage : public Stage {
 public:
  using Options = StereoObjectsStageOptions;

  /// `transforms` and `monitor` must outlive the stage. Throws OptionError.
  StereoObjectsStage(const Checked<StereoObjectsStageOptions>& options,
                     const TransformBuffer& transforms, StageMonitor& monitor);

  /// Of the right camera; the newest one is used.
  void handleCameraInfo(const sensor_msgs::CameraInfo& message);

  /// Sets the alignment; the newest one is used.
  void handleAlignment(const StereoAlignmentMessage& message);

  /// Points with velocity, in the vehicle's frame.
  void handleVelocities(const sensor_msgs::PointCloud2& message);

  /// Returns objects in the vehicle's frame at the cloud's stamp; null if the cloud was dropped, or
  /// its objects wait. Objects of an earlier cloud that need not wait any longer are returned
  /// first.
  ObjectArrayPtr handleCloud(const sensor_msgs::PointCloud2& message);

  /// Returns the next objects that have finished waiting; null if there are none. Call it until
  /// null, after each input and periodically. `now`: ROS time.
  ObjectArrayPtr next(Stamp now);

  void connect(StagePorts& ports) override;
  bool publishNext(Stamp now) override;
  double maxWait() const override { return options_.wait.max_wait; }

 private:
  void reset();
  /// Throws InputError (`bad_camera`) for a camera that cannot see the road from its mount.
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
  std::uint64_t bad_points_ = 0;  ///< invalid points with velocity, since construction
  StagePublisher<ObjectArray> published_;
};

}  // namespace datmo
