// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <string>

#include <Eigen/Geometry>

#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>

#include "datmo_fusion/ros/convert/messages.h"
#include "datmo_fusion/ros/display/camera_view_options.h"
#include "datmo_fusion/ros/stage/camera_input.h"
#include "datmo_fusion/ros/stage/stage_runner.h"
#include "datmo_fusion/ros/transform_buffer.h"

namespace cv {
class Mat;
}

namespace datmo {

/// Draws tracks as perspective boxes on the rectified image of a camera.
///
/// Each track is drawn at its position at the exposure: it is moved by its velocity from the stamp
/// of its list, the nearest in time, to the image's. An image waits until tf knows the camera's
/// pose; nothing blocks. Bad input is dropped and reported to the monitor, never thrown:
/// `missing_camera_info`, `bad_camera_info`, `wrong_size`, `wrong_frame`, `bad_encoding`,
/// `missing_transform`, and what StageRunner::check rejects. An image without tracks close enough
/// in time is shown without boxes (`old_tracks`, a warning).
class CameraView {
 public:
  /// `transforms` and `monitor` must outlive this. Throws OptionError.
  CameraView(const Checked<CameraViewOptions>& options, const TransformBuffer& transforms,
             StageMonitor& monitor);

  /// Of the rectified images (matrix P); the newest one is used.
  void handleCameraInfo(const sensor_msgs::CameraInfo& message);

  void handleTracks(const TrackArrayConstPtr& message);

  /// Adds an image to the queue. `now`: ROS time.
  void handleImage(const sensor_msgs::ImageConstPtr& message, Stamp now);

  /// Returns the next image of the queue whose tracks and transform are available, as bgr8 with its
  /// boxes and its own header; null if there is none. Call it until null, after each new input.
  sensor_msgs::ImagePtr next(Stamp now);

 private:
  struct Waiting {
    sensor_msgs::ImageConstPtr image;
    Stamp since;
  };

  bool hasWaitedTooLong(const Waiting& waiting, Stamp now) const;
  const TrackArray* nearestTracks(Stamp stamp) const;
  sensor_msgs::ImagePtr draw(const sensor_msgs::ImageConstPtr& image, bool wait_for_tracks);
  void drawTracks(const TrackArray& tracks, Stamp stamp, const Eigen::Isometry3d& fixed_in_camera,
                  cv::Mat& canvas) const;

  CameraViewOptions options_;
  const TransformBuffer& transforms_;
  StageMonitor& monitor_;
  StageRunner runner_;
  CameraInput camera_;
  std::deque<TrackArrayConstPtr> tracks_;
  std::deque<Waiting> queue_;
};

}  // namespace datmo
