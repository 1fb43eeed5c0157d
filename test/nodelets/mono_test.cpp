// SPDX-License-Identifier: BSD-3-Clause
// Images, camera info, mount and objects pass through the nodelet with OpenCV's people detector, in
// its own thread, to lists at the exposures' stamps; an image that was not exposed is counted.
// Images and scans pass through another nodelet to grids.
#include <algorithm>
#include <cstdint>

#include "chain.h"
#include "ros/camera_samples.h"
#include <gtest/gtest.h>

#include "datmo_fusion/ros/convert/message_conversion.h"
#include "datmo_fusion/ros/stage/stamp_check.h"

namespace datmo::mono_test {
namespace {

constexpr samples::CameraSample kCamera{320, 240, 200.0};
constexpr std::uint8_t kDark = 60;
constexpr std::uint8_t kBright = 200;

class Camera : public Listener {
 public:
  Camera() {
    lists_ = node_.subscribe<ObjectArray>(
        "objects/mono", 10,
        [this](const ObjectArrayConstPtr& message) { named.push_back(message); });
  }

  bool isConnected() const {
    return images_.getNumSubscribers() > 0 && objects_.getNumSubscribers() > 0 &&
           infos_.getNumSubscribers() > 0 && lists_.getNumPublishers() > 0;
  }

  /// The camera 1.5 m above the ground, an object 10 m ahead; an image of stripes, or of one gray.
  void send(double seconds, bool exposed) {
    const ros::Time stamp(seconds);
    mounts_.publish(samples::transforms({samples::cameraMount("base_link", 1.5)}));
    infos_.publish(kCamera.info(seconds));
    objects_.publish(objects(stamp));
    images_.publish(image(stamp, exposed));
  }

  std::vector<ObjectArrayConstPtr> named;

 private:
  static ObjectArray objects(const ros::Time& stamp) {
    Object object;
    object.box = {Pose2(10.0, 0.0, 0.0), 0.5, 0.5};
    ObjectList list;
    list.stamp = toStamp(stamp);
    list.objects = {object};
    return toMessage(list, "base_link");
  }

  static sensor_msgs::Image image(const ros::Time& stamp, bool exposed) {
    sensor_msgs::Image message = kCamera.image(stamp.toSec(), kDark);
    const auto period = 2 + static_cast<std::size_t>(stamp.nsec % 7);  // not frozen
    for (std::size_t i = 0; exposed && i < message.data.size(); i += period) {
      message.data[i] = kBright;
    }
    return message;
  }

  ros::NodeHandle node_;
  ros::Publisher mounts_ = node_.advertise<tf2_msgs::TFMessage>("/tf_static", 10);
  ros::Publisher infos_ = node_.advertise<sensor_msgs::CameraInfo>("camera_info", 10);
  ros::Publisher images_ = node_.advertise<sensor_msgs::Image>("image", 10);
  ros::Publisher objects_ = node_.advertise<ObjectArray>("objects", 10);
  ros::Subscriber lists_;
};

TEST(MonoClassifierNodeletTest, ListsHaveTheStampsOfExposures) {
  Camera camera;
  ASSERT_TRUE(camera.waitFor([&] { return camera.isConnected(); }));
  double seconds = 1.0;
  ASSERT_TRUE(camera.waitFor([&] {
    seconds += 0.1;
    camera.send(seconds, true);
    return camera.waitFor([&] { return !camera.named.empty(); }, 0.2);
  }));
  const ObjectArray& list = *camera.named.front();
  EXPECT_EQ(list.header.frame_id, "base_link");
  EXPECT_GT(list.header.stamp, ros::Time(1.0));
  EXPECT_LE(list.header.stamp, ros::Time(seconds + 0.01));
  EXPECT_TRUE(list.objects.empty()) << "nobody is in stripes";
  EXPECT_TRUE(camera.waitFor([&] {
    seconds += 0.1;
    camera.send(seconds, false);
    return camera.waitFor(
        [&] { return camera.diagnostic("mono_classifier", "dropped: blank_image") > 0.0; }, 0.2);
  }));
}

TEST(MonoGridNodeletTest, AnImageAndItsScanMakeAGrid) {
  constexpr samples::CameraSample kRoadCamera{1000, 400, 500.0};
  constexpr Percent kFree = 20;
  Listener listener;
  ros::NodeHandle node;
  const auto mounts = node.advertise<tf2_msgs::TFMessage>("/tf_static", 1);
  const auto infos = node.advertise<sensor_msgs::CameraInfo>("road_camera_info", 1);
  const auto images = node.advertise<sensor_msgs::Image>("road_image", 1);
  const auto scans = node.advertise<sensor_msgs::LaserScan>("scan", 1);
  nav_msgs::OccupancyGridConstPtr grid;
  const auto grids = node.subscribe<nav_msgs::OccupancyGrid>(
      "grids/mono", 1, [&grid](const nav_msgs::OccupancyGridConstPtr& message) { grid = message; });
  auto scanner = samples::transform("base_link", "scanner", 0.0);
  scanner.transform.translation.z = 0.4;
  const auto mount = samples::transforms({samples::cameraMount("base_link", 1.5), scanner});
  double seconds = 1.0;
  std::uint8_t number = 0;
  ASSERT_TRUE(listener.waitFor([&] {
    seconds += 0.1;
    mounts.publish(mount);
    infos.publish(kRoadCamera.info(seconds));
    scans.publish(samples::scanWithoutReturns(seconds));
    images.publish(kRoadCamera.road(seconds, ++number));
    return listener.waitFor([&] { return grid != nullptr; }, 0.2);
  }));
  EXPECT_EQ(grid->header.frame_id, "base_link");
  EXPECT_GT(grid->header.stamp, ros::Time(1.0));
  EXPECT_LE(grid->header.stamp, ros::Time(seconds + 0.01));
  EXPECT_GT(std::count(grid->data.begin(), grid->data.end(), kFree), 500) << "the road is free";
}

}  // namespace
}  // namespace datmo::mono_test
