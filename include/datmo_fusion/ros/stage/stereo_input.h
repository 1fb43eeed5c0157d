// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include <sensor_msgs/CameraInfo.h>
#include <std_msgs/Header.h>

#include "datmo_fusion/common/angle.h"
#include "datmo_fusion/ros/convert/cloud_conversion.h"
#include "datmo_fusion/ros/convert/messages.h"
#include "datmo_fusion/ros/frame_options.h"
#include "datmo_fusion/ros/shared_keys.h"
#include "datmo_fusion/ros/stage/stage_monitor.h"
#include "datmo_fusion/ros/stage/stamp_check.h"
#include "datmo_fusion/ros/stereo_camera_options.h"
#include "datmo_fusion/ros/transform_buffer.h"
#include "datmo_fusion/sensor_model/road_plane.h"
#include "datmo_fusion/sensor_model/stereo_alignment.h"
#include "datmo_fusion/sensor_model/stereo_cloud.h"

namespace datmo {

/// Common options of the stages that use a stereo or depth camera's clouds.
struct StereoInputOptions {
  FrameOptions frames;  ///< shared by all stages
  StereoCameraOptions camera;
  StreamOptions input;

  void visit(OptionVisitor& visitor);
  /// Keys of `camera`.
  static SharedKeys cameraKeys();
  /// These, and a stage's own `road` and `effective_range`.
  static SharedKeys sharedKeys();
};

/// Converts clouds of a stereo or depth camera for the core: with the camera's geometry from its
/// info, or from the options until that is received, its noise from the options, and its mount from
/// tf. Points outside the camera's range (min_depth, max_depth) are dropped.
class StereoInput {
 public:
  /// `transforms` must outlive this. Throws OptionError, also for an active_stereo without baseline
  /// and for a min_depth that is not below max_depth.
  StereoInput(const Checked<StereoInputOptions>& options, const TransformBuffer& transforms);

  /// Sets the info of the right camera, or of the depth image; the newest one is used. Throws
  /// InputError (`bad_camera_info`).
  void update(const sensor_msgs::CameraInfo& message);

  /// Sets the alignment of the clouds with the scanner's points from now on: the disparity bias,
  /// which is the camera's, is corrected, and clouds are rejected while they are not usable, until
  /// `StereoCameraOptions::alignment_hold` after its stamp. No effect if `camera/align` is off, or
  /// for a camera that does not measure disparities. Throws InputError (`bad_alignment`).
  void update(const StereoAlignmentMessage& message);

  /// Whether the camera is compared with the scanner: this is enabled, and it measures disparities.
  bool isAligned() const {
    const DepthPrinciple principle = options_.camera.principle;
    return options_.camera.align &&
           (principle == DepthPrinciple::kStereo || principle == DepthPrinciple::kActiveStereo);
  }

  /// Returns the cloud with `points` of a message with this header; they are transformed to the
  /// camera's frame, and must outlive the result. Throws InputError (`missing_camera_info`,
  /// `missing_transform`, `no_valid_point` if none is within the camera's range, `camera_disagrees`
  /// if the alignment is not usable).
  StereoCloud cloudOf(const std_msgs::Header& header, CloudPoints& points) const;

 private:
  /// Whether the alignment says that the clouds are unusable at this stamp.
  bool isRefused(Stamp stamp) const;
  /// Throws InputError (`missing_camera_info`).
  StereoCamera camera() const;
  /// The camera as far as the options define it. Throws like camera().
  StereoCamera configuredCamera() const;

  StereoInputOptions options_;
  const TransformBuffer& transforms_;
  std::optional<StereoCamera> camera_;  ///< from the last camera info
  StereoAlignment alignment_;           ///< the newest; all 0 before the first
};

/// Reports the road under a cloud as figures.
void showRoad(bool seen, const RoadPlane& road, StageMonitor& monitor);

}  // namespace datmo
