// SPDX-License-Identifier: BSD-3-Clause
// Image, camera info, tf and tracks pass through the nodelet to an image with a box; and no image
// is taken while nobody subscribes.
#include "chain.h"
#include "ros/camera_samples.h"
#include <gtest/gtest.h>

#include "datmo_fusion/ros/convert/message_conversion.h"

namespace datmo::camera_view_test {
namespace {

constexpr samples::CameraSample kCamera{320, 240, 200.0};
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
    tf_.publish(samples::transforms({samples::cameraMount("map", 1.5, seconds)}));
    infos_.publish(kCamera.info(seconds));
    images_.publish(kCamera.image(seconds, kGray));
    tracks_.publish(track(stamp));
  }

  sensor_msgs::ImageConstPtr picture;  ///< the latest one

 private:
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

TEST(CameraViewNodeletTest, DrawsTracksOnImagesWhileThereIsASubscriber) {
  Camera camera;
  camera.look();
  ASSERT_TRUE(camera.waitFor([&] { return camera.isLookedAt(); }));
  // Images without the track come first if its topic is connected after the images'. The lower edge
  // of the car's rear, 10 m away and 1.5 m below the camera, is at 120 px + 30 px.
  const auto has_box = [&] {
    return camera.picture && camera.picture->data.at(std::size_t{150} * camera.picture->step +
                                                     3 * std::size_t{160}) != kGray;
  };
  double seconds = 1.0;
  ASSERT_TRUE(camera.waitFor([&] {
    seconds += 0.1;
    camera.send(seconds);
    return camera.waitFor(has_box, 0.1);
  }));
  EXPECT_EQ(camera.picture->encoding, "bgr8");
  camera.lookAway();
  EXPECT_TRUE(camera.waitFor([&] { return !camera.isLookedAt(); }));
}

}  // namespace
}  // namespace datmo::camera_view_test
