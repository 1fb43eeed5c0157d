// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "ros/pedestrian_sample.h"
#include "run_bag/stereo_images.h"
#include "run_bag_drive.h"
#include "stereo_pair_sample.h"

#include "datmo_fusion/ros/convert/messages.h"

namespace datmo {

inline constexpr int kStereoClouds = 15;               // one for every second scan
inline constexpr double kCloudPeriod = 2.0 * kPeriod;  // s
inline constexpr auto kScanCount = static_cast<std::size_t>(kScans);
inline constexpr auto kCloudCount = static_cast<std::size_t>(kStereoClouds);

/// Forward is z, right is x (REP 103).
inline geometry_msgs::TransformStamped cameraMount(const std::string& frame) {
  geometry_msgs::TransformStamped mount =
      toTransform(Pose2(1.0, 0.0, 0.0), kStart, "base_link", frame);
  mount.transform.translation.z = 1.2;
  mount.transform.rotation.x = -0.5;
  mount.transform.rotation.y = 0.5;
  mount.transform.rotation.z = -0.5;
  mount.transform.rotation.w = 0.5;
  return mount;
}

/// A drive with a stereo camera that sees a wall.
class StereoRunBag : public RunBag {
 protected:
  /// The camera is not compared with the scanner, which does not see its wall.
  StereoRunBag() {
    writeConfig(
        "{stereo_image_proc: {stereo_algorithm: 1, disparity_range: 32}, "
        "stereo_camera: {align: false}}");
  }

  /// Calls `write(bag, stamp)` for each of the stereo camera's stamps.
  template <typename Write>
  void append(const Write& write) const {
    rosbag::Bag bag(arguments_.input, rosbag::bagmode::Append);
    tf2_msgs::TFMessage mount;
    mount.transforms.push_back(cameraMount(sample_.frame));
    bag.write("/tf_static", toTime(kStart), mount);
    for (int i = 0; i < kStereoClouds; ++i) {
      write(bag, kStart + i * kCloudPeriod);
    }
  }

  void appendImages(const std::string& name = "image_rect") const {
    append([&](rosbag::Bag& bag, Stamp stamp) {
      for (const bool right : {false, true}) {
        const std::string camera = right ? "/stereo/right/" : "/stereo/left/";
        bag.write(camera + name, toTime(stamp), sample_.image(stamp, right, "mono8"));
        bag.write(camera + "camera_info", toTime(stamp), sample_.info(stamp, right));
      }
    });
  }

  /// Appends the clouds that stereo_image_proc makes of the images.
  void appendClouds() const {
    StageMonitor monitor("stereo_image_proc");
    StereoImagesOptions options;
    options.stereo_algorithm = 1;
    options.disparity_range = 32;
    StereoImages images(options, monitor);
    append([&](rosbag::Bag& bag, Stamp stamp) {
      images.handleImage(StereoSide::kLeft, sample_.image(stamp, false, "mono8"));
      images.handleInfo(StereoSide::kLeft, sample_.info(stamp, false));
      images.handleImage(StereoSide::kRight, sample_.image(stamp, true, "mono8"));
      bag.write("/stereo/right/camera_info", toTime(stamp), sample_.info(stamp, true));
      bag.write("/stereo/points2", toTime(stamp),
                images.handleInfo(StereoSide::kRight, sample_.info(stamp, true)));
    });
  }

  /// Writes another system's message of each scan's time: `message(stamp)`.
  template <typename Message>
  void appendEachScan(const std::string& topic, const Message& message) const {
    rosbag::Bag bag(arguments_.input, rosbag::bagmode::Append);
    for (int i = 0; i < kScans; ++i) {
      const Stamp stamp = kStart + i * kPeriod;
      bag.write(topic, toTime(stamp), message(stamp));
    }
  }

  StereoPairSample sample_;
};

}  // namespace datmo
