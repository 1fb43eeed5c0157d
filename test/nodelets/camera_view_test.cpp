// SPDX-License-Identifier: BSD-3-Clause
// Image, camera info, tf and tracks through the nodelet to an image with a box; and no image is
// taken while nobody looks.
#include "chain.h"
#include <gtest/gtest.h>

#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>

#include "datmo_fusion/ros/convert/message_conversion.h"

namespace datmo {
namespace {

constexpr std::uint32_t kWidth = 320;
constexpr std::uint32_t kHeight = 240;
constexpr double kFocalLength = 200.0;  // px
constexpr std::uint8_t kGray = 60;

class Camera : public Listener {
 public:
  bool isLookedAt() const { return images_.getNumSubscribers() > 0; }

  void look() {
    view_ = node_.subscribe<sensor_msgs::Image>(
        "camera_view", 1, [this](const sensor_msgs::ImageConstPtr& message) { picture = message; });
  }

  void lookAway() { view_.shutdown(); }

  /// The camera 1.5 m above the ground, and a vehicle 10 m ahead of it.
  void send(double seconds) {
    const ros::Time stamp(seconds);
    tf_.publish(mount(stamp));
    infos_.publish(info(stamp));
    images_.publish(image(stamp));
    tracks_.publish(track(stamp));
  }

  sensor_msgs::ImageConstPtr picture;  ///< the last one

 private:
  static tf2_msgs::TFMessage mount(const ros::Time& stamp) {
    geometry_msgs::TransformStamped transform;
    transform.header.frame_id = "map";
    transform.header.stamp = stamp;
    transform.child_frame_id = "camera";
    transform.transform.translation.z = 1.5;
    transform.transform.rotation.x = -0.5;
    transform.transform.rotation.y = 0.5;
    transform.transform.rotation.z = -0.5;
    transform.transform.rotation.w = 0.5;
    tf2_msgs::TFMessage message;
    message.transforms = {transform};
    return message;
  }

  static sensor_msgs::CameraInfo info(const ros::Time& stamp) {
    sensor_msgs::CameraInfo message;
    message.header.frame_id = "camera";
    message.header.stamp = stamp;
    message.width = kWidth;
    message.height = kHeight;
    message.K = {kFocalLength, 0.0, 160.0, 0.0, kFocalLength, 120.0, 0.0, 0.0, 1.0};
    message.R = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};
    message.P = {kFocalLength, 0.0, 160.0, 0.0, 0.0, kFocalLength, 120.0, 0.0, 0.0, 0.0, 1.0, 0.0};
    return message;
  }

  static sensor_msgs::Image image(const ros::Time& stamp) {
    sensor_msgs::Image message;
    message.header.frame_id = "camera";
    message.header.stamp = stamp;
    message.encoding = "mono8";
    message.width = kWidth;
    message.height = kHeight;
    message.step = kWidth;
    message.data.assign(std::size_t{kWidth} * kHeight, kGray);
    return message;
  }

  static TrackArray track(const ros::Time& stamp) {
    TrackMessage track;
    track.pose = toMessage(Pose2(12.0, 0.0, 0.0));
    track.size.x = 4.0;
    track.size.y = 2.0;
    track.size.z = 1.5;
    TrackArray message;
    message.header.frame_id = "map";
    message.header.stamp = stamp;
    message.tracks = {track};
    return message;
  }

  ros::NodeHandle node_;
  ros::Publisher tf_ = node_.advertise<tf2_msgs::TFMessage>("/tf", 10);
  ros::Publisher infos_ = node_.advertise<sensor_msgs::CameraInfo>("camera_info", 10);
  ros::Publisher images_ = node_.advertise<sensor_msgs::Image>("image", 10);
  ros::Publisher tracks_ = node_.advertise<TrackArray>("tracks", 10);
  ros::Subscriber view_;
};

TEST(CameraViewNodeletTest, DrawsTracksOnImagesWhileSomebodyLooks) {
  Camera camera;
  camera.look();
  ASSERT_TRUE(camera.waitFor([&] { return camera.isLookedAt(); }));
  double seconds = 1.0;
  ASSERT_TRUE(camera.waitFor([&] {
    seconds += 0.1;
    camera.send(seconds);
    return camera.waitFor([&] { return camera.picture != nullptr; }, 0.1);
  }));
  EXPECT_EQ(camera.picture->encoding, "bgr8");
  // The lower edge of its rear, 10 m away and 1.5 m below the camera: 120 px + 30 px.
  const std::size_t pixel = std::size_t{150} * camera.picture->step + 3 * std::size_t{160};
  EXPECT_NE(camera.picture->data[pixel], kGray);
  camera.lookAway();
  EXPECT_TRUE(camera.waitFor([&] { return !camera.isLookedAt(); }));
}

}  // namespace
}  // namespace datmo

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "camera_view_test");
  return RUN_ALL_TESTS();
}
