// SPDX-License-Identifier: BSD-3-Clause
// Raw images of a stereo camera pass through the nodelets of image_proc and stereo_image_proc, in
// the same manager, to the grid of stereo_grid and the objects of stereo_objects.
#include <random>

#include "chain.h"
#include <gtest/gtest.h>

#include <sensor_msgs/Image.h>

#include "datmo_fusion/ros/convert/grid_conversion.h"

namespace datmo::stereo_images_test {
namespace {

constexpr std::uint32_t kColumns = 320;
constexpr std::uint32_t kRows = 240;
constexpr double kFocalLength = 300.0;   // px
constexpr double kBaseline = 0.3;        // m
constexpr std::uint32_t kDisparity = 9;  // px
constexpr double kDepth = kFocalLength * kBaseline / kDisparity;
constexpr double kPeriod = 0.1;  // s

/// Camera info of one of a pair; `baseline`: m, 0 for the left one.
sensor_msgs::CameraInfo cameraInfo(double baseline) {
  constexpr double kMiddleColumn = 0.5 * (kColumns - 1);
  constexpr double kMiddleRow = 0.5 * (kRows - 1);
  sensor_msgs::CameraInfo info;
  info.width = kColumns;
  info.height = kRows;
  info.distortion_model = "plumb_bob";
  info.D.assign(5, 0.0);
  info.K = {kFocalLength, 0.0, kMiddleColumn, 0.0, kFocalLength, kMiddleRow, 0.0, 0.0, 1.0};
  info.R = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};
  info.P = {kFocalLength, 0.0,          kMiddleColumn, -kFocalLength * baseline,
            0.0,          kFocalLength, kMiddleRow,    0.0,
            0.0,          0.0,          1.0,           0.0};
  return info;
}

/// A wall across the whole image with a texture that does not repeat, `shift` columns to the left.
sensor_msgs::Image wall(std::uint32_t shift) {
  std::mt19937 random(1);
  sensor_msgs::Image image;
  image.width = kColumns;
  image.height = kRows;
  image.step = kColumns;
  image.encoding = "mono8";
  image.data.resize(std::size_t{kColumns} * kRows);
  std::vector<std::uint8_t> texture(kColumns + kDisparity);
  for (std::uint32_t row = 0; row < kRows; ++row) {
    for (std::uint8_t& pixel : texture) {
      pixel = static_cast<std::uint8_t>(random() % 256U);
    }
    std::copy_n(texture.begin() + shift, kColumns, image.data.begin() + row * kColumns);
  }
  return image;
}

class Cameras : public Chain {
 public:
  Cameras() {
    grid_ = node_.subscribe<nav_msgs::OccupancyGrid>(
        "grids/stereo", 1,
        [this](const nav_msgs::OccupancyGridConstPtr& message) { grid = message; });
    stereo_objects_ = node_.subscribe<ObjectArray>(
        "objects/stereo", 1,
        [this](const ObjectArrayConstPtr& message) { stereo_objects = message; });
  }

  void sendPair(double seconds) {
    setClock(seconds);
    const ros::Time stamp(World::kStart + seconds);
    send(left_, left_info_, wall(0), cameraInfo(0.0), stamp);
    send(right_, right_info_, wall(kDisparity), cameraInfo(kBaseline), stamp);
  }

  nav_msgs::OccupancyGridConstPtr grid;  ///< the last one
  ObjectArrayConstPtr stereo_objects;    ///< the last ones

 private:
  static void send(const ros::Publisher& images, const ros::Publisher& infos,
                   sensor_msgs::Image image, sensor_msgs::CameraInfo info, const ros::Time& stamp) {
    image.header.stamp = stamp;
    image.header.frame_id = "camera";
    info.header = image.header;
    infos.publish(info);
    images.publish(image);
  }

  ros::Publisher images(const std::string& side) {
    return node_.advertise<sensor_msgs::Image>("stereo/" + side + "/image_raw", 10);
  }
  ros::Publisher infos(const std::string& side) {
    return node_.advertise<sensor_msgs::CameraInfo>("stereo/" + side + "/camera_info", 10);
  }

  ros::NodeHandle node_;
  ros::Publisher left_ = images("left");
  ros::Publisher right_ = images("right");
  ros::Publisher left_info_ = infos("left");
  ros::Publisher right_info_ = infos("right");
  ros::Subscriber grid_;
  ros::Subscriber stereo_objects_;
};

TEST(StereoImagesTest, RawImagesLeadToAGridAndObjects) {
  Cameras cameras;
  ASSERT_TRUE(cameras.waitForNodelets());
  cameras.mountSensors();
  // The nodelets subscribe one after the other, each when the next one does.
  double seconds = 0.0;
  ASSERT_TRUE(cameras.waitFor([&] {
    cameras.sendPair(seconds);
    seconds += kPeriod;
    return cameras.waitFor([&] { return cameras.grid && cameras.stereo_objects; }, kPeriod);
  }));
  const SensorGrid grid = fromMessage(*cameras.grid);
  const double wall = World().cameraInBase().transform.translation.x + kDepth;
  const CellIndex ahead = grid.window().cellAt({wall, 0.0});
  bool occupied = false;
  for (int column = ahead.column - 2; column <= ahead.column + 2; ++column) {
    occupied = occupied || isOccupied(grid.at({column, ahead.row}));
  }
  EXPECT_TRUE(occupied) << "the wall at " << wall << " m";
  EXPECT_FALSE(isOccupied(grid.at(grid.window().cellAt({wall - 3.0, 0.0}))));
  EXPECT_EQ(cameras.stereo_objects->header.frame_id, "base_link");
  EXPECT_EQ(cameras.stereo_objects->views.size(), 1U);
}

}  // namespace
}  // namespace datmo::stereo_images_test
