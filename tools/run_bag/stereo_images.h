// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <utility>

#include "stereo_images_options.h"
#include "stereo_matcher.h"

#include <sensor_msgs/PointCloud2.h>

#include "datmo_fusion/ros/stage/stage.h"
#include "datmo_fusion/ros/stage/stage_runner.h"
#include "datmo_fusion/ros/stage/stereo_pairs.h"

namespace datmo {

/// Pairs the images of two cameras and publishes the cloud of each pair (StereoMatcher) on points2,
/// as stereo_image_proc does live, without a master.
///
/// Bad input is dropped through the monitor, never thrown.
class StereoImages : public Stage {
 public:
  using Options = StereoImagesOptions;
  using Match = std::function<sensor_msgs::PointCloud2Ptr(const StereoPair& pair)>;

  /// `monitor` must outlive the stage. Throws OptionError.
  StereoImages(const StereoImagesOptions& options, StageMonitor& monitor);
  StereoImages(const StereoImages&) = delete;
  StereoImages& operator=(const StereoImages&) = delete;

  const StereoImagesOptions& options() const { return options_; }

  /// Calls `match` for the cloud of a pair from now on, which must return (or throw) what
  /// StereoMatcher does with these options.
  void matchWith(Match match) { match_ = std::move(match); }

  /// The cloud of the pair that the message completes; null if there is none. An image is mono8,
  /// rgb8 or bgr8.
  sensor_msgs::PointCloud2Ptr handleImage(StereoSide side, const sensor_msgs::ImageConstPtr& image);
  sensor_msgs::PointCloud2Ptr handleInfo(StereoSide side,
                                         const sensor_msgs::CameraInfoConstPtr& info);

  void connect(StagePorts& ports) override;

 private:
  /// Throws InputError.
  sensor_msgs::PointCloud2Ptr serve(const std::optional<StereoPair>& pair);

  StereoImagesOptions options_;
  StageMonitor& monitor_;
  StereoPairs pairs_;
  std::uint64_t unpaired_ = 0;  ///< frames that were reported
  StageRunner runner_;
  StereoMatcher matcher_;
  Match match_;
};

}  // namespace datmo
