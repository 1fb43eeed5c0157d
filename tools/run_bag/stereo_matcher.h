// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "stereo_images_options.h"

#include <sensor_msgs/PointCloud2.h>

#include "datmo_fusion/ros/stage/stereo_pairs.h"

namespace stereo_image_proc {
class StereoProcessor;
}

namespace datmo {

/// Converts a pair of images to a cloud, as the nodelets image_proc/rectify,
/// stereo_image_proc/disparity and stereo_image_proc/point_cloud2 do: with their own library. The
/// result depends on the pair and the options alone. Not thread safe.
class StereoMatcher {
 public:
  /// Throws OptionError.
  explicit StereoMatcher(const StereoImagesOptions& options);
  ~StereoMatcher();
  StereoMatcher(const StereoMatcher&) = delete;
  StereoMatcher& operator=(const StereoMatcher&) = delete;

  /// Points: x, y, z (m, optical frame of the left camera) and rgb, one for each pixel; NaN where
  /// no disparity was found. The stamp is the left image's. Throws InputError for images or
  /// calibrations that the library cannot process.
  sensor_msgs::PointCloud2Ptr cloudOf(const StereoPair& pair) const;

 private:
  sensor_msgs::PointCloud2Ptr match(const StereoPair& pair) const;

  bool rectified_;
  std::unique_ptr<stereo_image_proc::StereoProcessor> processor_;
};

}  // namespace datmo
