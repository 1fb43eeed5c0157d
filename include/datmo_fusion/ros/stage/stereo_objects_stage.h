// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/PointCloud2.h>

#include "datmo_fusion/detection/stereo_object_detector.h"
#include "datmo_fusion/ros/convert/messages.h"
#include "datmo_fusion/ros/stage/stage.h"
#include "datmo_fusion/ros/stage/stage_runner.h"
#include "datmo_fusion/ros/stage/stereo_input.h"
#include "datmo_fusion/ros/transform_buffer.h"

namespace datmo {

struct StereoObjectsStageOptions : StereoInputOptions {
  StereoObjectDetectorOptions detector;

  void visit(OptionVisitor& visitor);
};

/// StereoObjectDetector between messages: the same one serves the nodelet and the bag runner. Bad
/// input is dropped through the monitor, never thrown. When the clock jumps back the road of the
/// last clouds is forgotten.
class StereoObjectsStage : public Stage {
 public:
  using Options = StereoObjectsStageOptions;

  /// `transforms` and `monitor` must outlive the stage. Throws OptionError.
  StereoObjectsStage(const StereoObjectsStageOptions& options, const TransformBuffer& transforms,
                     StageMonitor& monitor);

  /// Of the right camera; the newest one serves.
  void takeCameraInfo(const sensor_msgs::CameraInfo& message);

  /// Objects in the vehicle's frame at the cloud's stamp; null if the cloud was dropped.
  ObjectArrayPtr takeCloud(const sensor_msgs::PointCloud2& message);

  void connect(StagePorts& ports) override;

 private:
  /// Throws InputError (`bad_camera`) for one that is not mounted as one that sees the road.
  StereoObjects objectsOf(const StereoCloud& cloud);
  void show(const StereoObjects& objects);

  StereoObjectsStageOptions options_;
  StageMonitor& monitor_;
  StageRunner runner_;
  StereoInput input_;
  StereoObjectDetector detector_;
};

}  // namespace datmo
