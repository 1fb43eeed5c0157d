// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/convert/grid_conversion.h"

#include <limits>

#include "message_samples.h"
#include <gtest/gtest.h>

#include "datmo_fusion/grid/grid_window_options.h"

namespace datmo::grid_conversion_test {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// Three columns, two rows; its lower left corner is at (-0.3, 0.6) m.
SensorGrid smallGrid() {
  SensorGrid grid(Stamp::fromSeconds(samples::kStart), {0.3, 3, 2, {-1, 2}});
  grid.cells() = {-1, 0, 20, 50, 80, 100};
  return grid;
}

std::string reason(const std::function<void(nav_msgs::OccupancyGrid&)>& spoil) {
  nav_msgs::OccupancyGrid message = toMessage(smallGrid(), "base_link");
  spoil(message);
  return samples::reasonOf([&message] { fromMessage(message); });
}

TEST(GridConversion, AMessageHasThePositionOfTheCells) {
  const nav_msgs::OccupancyGrid message = toMessage(smallGrid(), "base_link");
  EXPECT_EQ(message.header.frame_id, "base_link");
  EXPECT_EQ(message.header.stamp, ros::Time(samples::kStart));
  EXPECT_EQ(message.info.width, 3U);
  EXPECT_EQ(message.info.height, 2U);
  EXPECT_FLOAT_EQ(message.info.resolution, 0.3F);
  EXPECT_DOUBLE_EQ(message.info.origin.position.x, -0.3);
  EXPECT_DOUBLE_EQ(message.info.origin.position.y, 0.6);
  EXPECT_DOUBLE_EQ(message.info.origin.orientation.w, 1.0);
  EXPECT_EQ(message.data, (std::vector<std::int8_t>{-1, 0, 20, 50, 80, 100}));
}

TEST(GridConversion, RoundTripIsTheSame) {
  const SensorGrid grid = fromMessage(toMessage(smallGrid(), "base_link"));
  EXPECT_EQ(grid.stamp(), smallGrid().stamp());
  EXPECT_EQ(grid.window(), smallGrid().window());
  EXPECT_EQ(grid.cells(), smallGrid().cells());
}

TEST(GridConversion, WindowsOfAnyCellSizeSurviveARoundTrip) {
  for (int millimeters = 20; millimeters <= 5000; millimeters += 7) {
    GridWindowOptions options;
    options.length = 50.0;
    options.width = 30.0;
    options.cell_size = millimeters / 1000.0;
    const GridWindow window = options.window();
    const SensorGrid grid = fromMessage(toMessage(SensorGrid({}, window), "base_link"));
    EXPECT_EQ(grid.window(), window) << millimeters << " mm";
  }
}

TEST(GridConversion, OriginsOfOthersMayBeRounded) {
  EXPECT_EQ(reason([](auto& message) {
              message.info.origin.position.x = static_cast<double>(-0.3F);
              message.info.origin.position.y = 2 * static_cast<double>(0.3F);
            }),
            "");
}

TEST(GridConversion, OriginsThatAreNotOnTheLatticeAreRefused) {
  EXPECT_EQ(reason([](auto& message) { message.info.origin.position.x += 0.1; }), "bad_grid");
  EXPECT_EQ(reason([](auto& message) { message.info.origin.position.y += 0.15; }), "bad_grid");
  EXPECT_EQ(reason([](auto& message) { message.info.origin.position.x = 1e12; }), "bad_pose");
  EXPECT_EQ(reason([](auto& message) {
              message.info.origin.orientation.z = 1.0;
              message.info.origin.orientation.w = 0.0;
            }),
            "bad_grid");
  EXPECT_EQ(reason([](auto& message) { message.info.origin.position.x = kNan; }), "bad_pose");
  EXPECT_EQ(reason([](auto& message) { message.info.origin.orientation.w = 0.0; }), "bad_pose");
}

TEST(GridConversion, InvalidCellSizesAreRefused) {
  for (const float size : {0.0F, -0.3F, 1e-6F, 1e6F, static_cast<float>(kNan)}) {
    EXPECT_EQ(reason([size](auto& message) { message.info.resolution = size; }), "bad_grid")
        << size;
  }
}

TEST(GridConversion, AnotherNumberOfCellsIsRefused) {
  EXPECT_EQ(reason([](auto& message) { message.data.pop_back(); }), "bad_grid");
  EXPECT_EQ(reason([](auto& message) { message.data.push_back(0); }), "bad_grid");
  EXPECT_EQ(reason([](auto& message) { message.info.width = 0; }), "bad_grid");
  EXPECT_EQ(reason([](auto& message) {
              message.info.width = 0;
              message.data.clear();
            }),
            "bad_grid");
  EXPECT_EQ(reason([](auto& message) { message.info.height = 0xFFFFFFFF; }), "bad_grid");
}

TEST(GridConversion, InvalidPercentsAreRefused) {
  EXPECT_EQ(reason([](auto& message) { message.data[3] = 101; }), "bad_grid");
  EXPECT_EQ(reason([](auto& message) { message.data[0] = -2; }), "bad_grid");
}

TEST(GridConversion, MessagesNameTheError) {
  nav_msgs::OccupancyGrid message = toMessage(smallGrid(), "base_link");
  message.data.pop_back();
  try {
    fromMessage(message);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(),
                 "grid of 3 x 2 cells with 5 values: expected one for each cell, and at least one");
  }
}

}  // namespace
}  // namespace datmo::grid_conversion_test
