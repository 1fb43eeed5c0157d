// SPDX-License-Identifier: BSD-3-Clause
#include "stereo_images.h"

#include "datmo_fusion/ros/convert/stereo_image_conversion.h"
#include "datmo_fusion/ros/stage/stage_inputs.h"

namespace datmo {

StereoImages::StereoImages(const StereoImagesOptions& options, StageMonitor& monitor)
    : options_(options),
      monitor_(monitor),
      pairs_(options.sync.pairTolerance()),
      runner_(monitor, StreamOptions(), "forgets all images", [this] { pairs_.clear(); }),
      matcher_(options),
      match_([this](const StereoPair& pair) { return matcher_.cloudOf(pair); }) {}

sensor_msgs::PointCloud2Ptr StereoImages::handleImage(StereoSide side,
                                                      const sensor_msgs::ImageConstPtr& image) {
  return runner_.serve([&] {
    runner_.check(side == StereoSide::kLeft ? "left" : "right", image->header.stamp);
    checkImage(*image);
    return serve(pairs_.handleImage(side, image));
  });
}

sensor_msgs::PointCloud2Ptr StereoImages::handleInfo(StereoSide side,
                                                     const sensor_msgs::CameraInfoConstPtr& info) {
  return runner_.serve([&] { return serve(pairs_.handleInfo(side, info)); });
}

sensor_msgs::PointCloud2Ptr StereoImages::serve(const std::optional<StereoPair>& pair) {
  if (pairs_.unpaired() > unpaired_) {
    unpaired_ = pairs_.unpaired();
    monitor_.warned(unpairedImage());
  }
  if (!pair) {
    return nullptr;
  }
  sensor_msgs::PointCloud2Ptr cloud = match_(*pair);
  runner_.processed(pair->left.stamp);
  return cloud;
}

void StereoImages::connect(StagePorts& ports) {
  connectImages(ports, *this, ports.out<sensor_msgs::PointCloud2>("points2"));
}

}  // namespace datmo
