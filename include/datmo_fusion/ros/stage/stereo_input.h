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

/// What the stages of a stereo or depth camera's clouds have in common.
struct StereoInputOptions {
  FrameOptions frames;  ///< of all stages
  StereoCameraOptions camera;
  StreamOptions input;

  void visit(OptionVisitor& visitor);
  /// Of `camera`.
  static SharedKeys cameraKeys();
  /// Of it, and of a stage's own `road` and `effective_range`.
  static SharedKeys sharedKeys();
};

/// Clouds of a stereo or depth camera as messages -> as the core takes them: with the camera as its
/// info, or the options until that comes, say, its noise as the options say, and its mount as tf
/// says. Points out of the camera's range (min_depth, max_depth) are left out.
class StereoInput {
 public:
  /// `transforms` must outlive this. Throws OptionError; for an active_stereo without baseline, and
  /// a min_depth that is not below max_depth, as well.
  StereoInput(const Checked<StereoInputOptions>& options, const TransformBuffer& transforms);

  /// Of the right camera, or of the depth image; the newest one serves. Throws InputError
  /// (`bad_camera_info`).
  void take(const sensor_msgs::CameraInfo& message);

  /// How the clouds lie against the scanner's points, from now on: the bias of their disparities is
  /// taken out of them, as it is the camera's, and while they are not usable they are refused, for
  /// `camera/alignment_hold` after its stamp. Without effect where `camera/align` is off, and on a
  /// camera that measures no disparities. Throws InputError (`bad_alignment`).
  void take(const StereoAlignmentMessage& message);

  /// Whether the camera is compared with the scanner: it is to be, and matches disparities.
  bool isAligned() const {
    const DepthPrinciple principle = options_.camera.principle;
    return options_.camera.align &&
           (principle == DepthPrinciple::kStereo || principle == DepthPrinciple::kActiveStereo);
  }

  /// `points` of a message with this header; they are brought to the camera's frame, and must
  /// outlive the result. Throws InputError (`missing_camera_info`, `missing_transform`,
  /// `no_valid_point` if none is within the camera's range, `camera_disagrees` if the alignment
  /// says so).
  StereoCloud cloudOf(const std_msgs::Header& header, CloudPoints& points) const;

 private:
  /// Whether the alignment says, at this stamp, that the clouds are of no use.
  bool isRefused(Stamp stamp) const;
  /// Throws InputError (`missing_camera_info`).
  StereoCamera camera() const;
  /// What the options know of it. Throws as camera() does.
  StereoCamera configuredCamera() const;

  StereoInputOptions options_;
  const TransformBuffer& transforms_;
  std::optional<StereoCamera> camera_;  ///< as the last camera info says
  StereoAlignment alignment_;           ///< the newest; at first none: all 0
};

/// The road under a cloud, as figures.
void showRoad(bool seen, const RoadPlane& road, StageMonitor& monitor);

}  // namespace datmo
