// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "stereo_images_options.h"

#include <sensor_msgs/PointCloud2.h>

#include "datmo_fusion/ros/stage/stage.h"
#include "datmo_fusion/ros/stage/stage_runner.h"
#include "datmo_fusion/ros/stage/stereo_pairs.h"

namespace stereo_image_proc {
class StereoProcessor;
}

namespace datmo {

/// Converts pairs of images to clouds, as the nodelets image_proc/rectify,
/// stereo_image_proc/disparity and stereo_image_proc/point_cloud2 publish them on points2: with
/// their own library and their parameters, without a master. Points: x, y, z (m, optical frame of
/// the left camera) and rgb, one for each pixel; NaN where no disparity was found. Its stamp is the
/// left image's.
///
/// Bad input is dropped through the monitor, never thrown.
class StereoImages : public Stage {
 public:
  using Options = StereoImagesOptions;

  /// `monitor` must outlive the stage. Throws OptionError.
  StereoImages(const StereoImagesOptions& options, StageMonitor& monitor);
  ~StereoImages() override;
  StereoImages(const StereoImages&) = delete;
  StereoImages& operator=(const StereoImages&) = delete;

  /// The cloud of the pair that the message completes; null if there is none. An image is mono8,
  /// rgb8 or bgr8.
  sensor_msgs::PointCloud2Ptr handleImage(StereoSide side, const sensor_msgs::ImageConstPtr& image);
  sensor_msgs::PointCloud2Ptr handleInfo(StereoSide side,
                                         const sensor_msgs::CameraInfoConstPtr& info);

  void connect(StagePorts& ports) override;

 private:
  /// These two throw InputError.
  sensor_msgs::PointCloud2Ptr serve(const std::optional<StereoPair>& pair);
  sensor_msgs::PointCloud2Ptr cloudOf(const StereoPair& pair) const;

  bool rectified_;
  StageMonitor& monitor_;
  StereoPairs pairs_;
  std::uint64_t unpaired_ = 0;  ///< frames that were reported
  StageRunner runner_;
  std::unique_ptr<stereo_image_proc::StereoProcessor> processor_;
};

}  // namespace datmo
