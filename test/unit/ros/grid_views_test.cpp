// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/display/grid_views.h"

#include <array>

#include "message_samples.h"
#include <boost/make_shared.hpp>
#include <gtest/gtest.h>

#include "datmo_fusion/ros/convert/grid_conversion.h"
#include "datmo_fusion/ros/convert/message_conversion.h"
#include "datmo_fusion/ros/stage/stamp_check.h"

namespace datmo::grid_views_test {
namespace {

using Pixel = std::array<int, 3>;  // red, green, blue

const Pixel kFree = {245, 245, 245};
const Pixel kOccupied = {20, 20, 20};
const Pixel kContradiction = {205, 0, 0};
const Pixel kUnknown = {112, 124, 142};
const Pixel kNoGrid = {52, 54, 60};

/// Panels of 100 x 120 px: a pixel is 0.1 m, the vehicle 100 px below a panel's upper border.
GridViewsOptions smallViews() {
  GridViewsOptions options;
  options.ahead = 10.0;
  options.behind = 2.0;
  options.to_side = 5.0;
  options.pixels_per_meter = 10.0;
  return options;
}

constexpr int kPanelWidth = 100;

/// Cells of 0.5 m, 20 m ahead and behind, 10 m to each side, all free.
SensorGrid freeGrid(double seconds = samples::kStart) {
  SensorGrid grid(Stamp::fromSeconds(seconds), {0.5, 80, 40, {-40, -20}});
  grid.cells().assign(grid.cells().size(), 0);
  return grid;
}

nav_msgs::OccupancyGridConstPtr message(const SensorGrid& grid,
                                        const std::string& frame = "base_link") {
  return boost::make_shared<nav_msgs::OccupancyGrid>(toMessage(grid, frame));
}

geometry_msgs::PoseWithCovarianceStampedConstPtr pose(const Pose2& base_in_map) {
  auto result = boost::make_shared<geometry_msgs::PoseWithCovarianceStamped>();
  result->pose.pose = toMessage(base_in_map);
  return result;
}

/// Returns the pixel of a point of the vehicle's frame (m) in the panel of this number.
Pixel pixelAt(const sensor_msgs::Image& image, int panel, double x, double y) {
  const int column = panel * (kPanelWidth + GridViews::kGap) + static_cast<int>((5.0 - y) * 10.0);
  const int row = GridViews::kTitleHeight + static_cast<int>((10.0 - x) * 10.0);
  const std::size_t at =
      static_cast<std::size_t>(row) * image.step + 3 * static_cast<std::size_t>(column);
  return {image.data.at(at), image.data.at(at + 1), image.data.at(at + 2)};
}

TEST(GridViews, PanelsAreSideBySide) {
  const auto image = GridViews(smallViews()).draw();
  EXPECT_EQ(image->encoding, "rgb8");
  EXPECT_EQ(image->width, 5U * kPanelWidth + 4U * GridViews::kGap);
  EXPECT_EQ(image->height, 120U + GridViews::kTitleHeight);
  EXPECT_EQ(image->step, 3 * image->width);
  EXPECT_EQ(image->data.size(), std::size_t{image->step} * image->height);
}

TEST(GridViews, ACellAheadAndLeftIsUpAndLeft) {
  SensorGrid grid = freeGrid();
  grid.at(grid.window().cellAt({6.2, 3.2})) = 100;  // x 6 to 6.5, y 3 to 3.5
  GridViews views(smallViews());
  views.handleGrid("lidar", message(grid));
  const auto image = views.draw();
  EXPECT_EQ(image->header.stamp, ros::Time(samples::kStart));
  EXPECT_EQ(image->header.frame_id, "base_link");
  for (const double x : {6.05, 6.45}) {
    for (const double y : {3.05, 3.45}) {
      EXPECT_EQ(pixelAt(*image, 0, x, y), kOccupied) << x << ", " << y;
    }
  }
  EXPECT_EQ(pixelAt(*image, 0, 5.95, 3.25), kFree);
  EXPECT_EQ(pixelAt(*image, 0, 6.55, 3.25), kFree);
  EXPECT_EQ(pixelAt(*image, 0, 6.25, 2.95), kFree);
  EXPECT_EQ(pixelAt(*image, 0, 6.25, 3.55), kFree);
}

TEST(GridViews, ShadesShowProbability) {
  SensorGrid grid = freeGrid();
  grid.at(grid.window().cellAt({6.2, 3.2})) = 40;
  grid.at(grid.window().cellAt({6.2, -3.2})) = kUnknownPercent;
  GridViews views(smallViews());
  views.handleGrid("stereo", message(grid));
  views.handleGrid("conflict", message(grid));
  const auto image = views.draw();
  EXPECT_EQ(pixelAt(*image, 1, 6.25, 3.25), (Pixel{155, 155, 155}));  // 0.6 * 245 + 0.4 * 20
  EXPECT_EQ(pixelAt(*image, 1, 6.25, -3.25), kUnknown);
  EXPECT_EQ(pixelAt(*image, 3, 6.25, 3.25), (Pixel{220, 90, 90}));  // square root of 0.4
}

TEST(GridViews, ContradictionIsRed) {
  SensorGrid grid = freeGrid();
  grid.at(grid.window().cellAt({6.2, 3.2})) = 100;
  GridViews views(smallViews());
  views.handleGrid("conflict", message(grid));
  EXPECT_EQ(pixelAt(*views.draw(), 3, 6.25, 3.25), kContradiction);
}

TEST(GridViews, CellsBeyondAGridAreUnknown) {
  SensorGrid grid(Stamp::fromSeconds(samples::kStart), {0.5, 2, 2, {4, 0}});
  grid.cells().assign(4, 0);
  GridViews views(smallViews());
  views.handleGrid("fused", message(grid));
  const auto image = views.draw();
  EXPECT_EQ(pixelAt(*image, 2, 2.05, 0.05), kFree);
  EXPECT_EQ(pixelAt(*image, 2, 3.05, 0.05), kUnknown);
  EXPECT_EQ(pixelAt(*image, 2, 2.05, -0.05), kUnknown);
}

TEST(GridViews, MissingGridsLeaveATitledPanel) {
  GridViews views(smallViews());
  views.handleGrid("lidar", message(freeGrid()));
  const auto image = views.draw();
  EXPECT_EQ(pixelAt(*image, 0, 5.0, 0.0), kFree);
  for (int panel = 1; panel < 5; ++panel) {
    EXPECT_EQ(pixelAt(*image, panel, 5.0, 0.0), kNoGrid) << panel;
    bool letters = false;
    for (int row = 0; row < GridViews::kTitleHeight; ++row) {
      for (int column = 0; column < kPanelWidth; ++column) {
        const int left = panel * (kPanelWidth + GridViews::kGap);
        letters |= image->data[static_cast<std::size_t>(row) * image->step +
                               3 * static_cast<std::size_t>(left + column)] > 200;
      }
    }
    EXPECT_TRUE(letters) << panel;
  }
}

TEST(GridViews, TheMapIsRotatedByThePose) {
  // The vehicle is at (100, 50) m and faces along y: 6 m ahead and 3 m left is (97, 56) m.
  SensorGrid map(Stamp::fromSeconds(samples::kStart), {0.5, 80, 80, {160, 60}});
  map.cells().assign(map.cells().size(), 0);
  map.at(map.window().cellAt({96.8, 56.2})) = 100;  // x 96.5 to 97, y 56 to 56.5
  GridViews views(smallViews());
  views.handleGrid("map", message(map, "map"));
  EXPECT_EQ(pixelAt(*views.draw(), 4, 6.25, 3.25), kNoGrid) << "nobody knows where the vehicle is";
  views.handlePose(pose({100.0, 50.0, M_PI_2}));
  const auto image = views.draw();
  for (const double x : {6.05, 6.45}) {
    for (const double y : {3.05, 3.45}) {
      EXPECT_EQ(pixelAt(*image, 4, x, y), kOccupied) << x << ", " << y;
    }
  }
  EXPECT_EQ(pixelAt(*image, 4, 5.95, 3.25), kFree);
  EXPECT_EQ(pixelAt(*image, 4, 6.25, 2.95), kFree);
}

TEST(GridViews, OldGridsOfASilentSourceAreNotShown) {
  GridViews views(smallViews());
  views.handleGrid("map", message(freeGrid(samples::kStart - 100.0), "map"));
  views.handlePose(pose({}));
  views.handleGrid("stereo", message(freeGrid()));
  views.handleGrid("lidar", message(freeGrid(samples::kStart + 0.9)));
  EXPECT_EQ(pixelAt(*views.draw(), 1, 5.0, 0.0), kFree);
  views.handleGrid("lidar", message(freeGrid(samples::kStart + 1.1)));
  EXPECT_EQ(pixelAt(*views.draw(), 1, 5.0, 0.0), kNoGrid);
  EXPECT_EQ(pixelAt(*views.draw(), 4, 5.0, 0.0), kFree) << "a map may be old";
}

TEST(GridViews, ANewRunOfTheClockForgets) {
  GridViews views(smallViews());
  views.handleGrid("stereo", message(freeGrid()));
  views.handleGrid("lidar", message(freeGrid(samples::kStart - 50.0)));
  const auto image = views.draw();
  EXPECT_EQ(pixelAt(*image, 0, 5.0, 0.0), kFree);
  EXPECT_EQ(pixelAt(*image, 1, 5.0, 0.0), kNoGrid);
}

TEST(GridViews, BadInputLeavesAnEmptyPanel) {
  auto bad = boost::make_shared<nav_msgs::OccupancyGrid>(toMessage(freeGrid(), "base_link"));
  bad->data.pop_back();
  auto nowhere = boost::make_shared<geometry_msgs::PoseWithCovarianceStamped>();
  GridViews views(smallViews());
  views.handleGrid("lidar", bad);
  views.handleGrid("fused", message(freeGrid()));
  views.handleGrid("map", message(freeGrid(), "map"));
  views.handlePose(nowhere);
  const auto image = views.draw();
  EXPECT_EQ(pixelAt(*image, 0, 5.0, 0.0), kNoGrid);
  EXPECT_EQ(pixelAt(*image, 2, 5.0, 0.0), kFree);
  EXPECT_EQ(pixelAt(*image, 4, 5.0, 0.0), kNoGrid);
}

TEST(GridViews, PanelsAreTheRequestedOnes) {
  GridViewsOptions options = smallViews();
  options.panels = "radar  map";
  EXPECT_EQ(GridViews(options).panels(), (std::vector<std::string>{"radar", "map"}));
  EXPECT_EQ(GridViews(options).draw()->width, 2U * kPanelWidth + GridViews::kGap);
}

TEST(GridViews, BadOptionsAreRefused) {
  for (const std::string panels : {"", "  ", "lidar lidar", "lidar, stereo", "2d", "a/b"}) {
    GridViewsOptions options = smallViews();
    options.panels = panels;
    EXPECT_THROW(GridViews{options}, OptionError) << "'" << panels << "'";
  }
  GridViewsOptions options = smallViews();
  options.ahead = 500.0;
  options.pixels_per_meter = 50.0;
  EXPECT_THROW(GridViews{options}, OptionError) << "panels of 500 x 25100 pixels";
  options.pixels_per_meter = 0.0;
  EXPECT_THROW(GridViews{options}, OptionError);
}

}  // namespace
}  // namespace datmo::grid_views_test
