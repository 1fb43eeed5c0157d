// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/display/grid_views.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include <boost/make_shared.hpp>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include <sensor_msgs/image_encodings.h>

#include "datmo_fusion/ros/convert/grid_conversion.h"
#include "datmo_fusion/ros/convert/message_conversion.h"
#include "datmo_fusion/ros/stage/input_error.h"
#include "datmo_fusion/ros/stage/stamp_check.h"

namespace datmo {

namespace {

const std::string kMap = "map";
const std::string kConflict = "conflict";

/// Maximum number of pixels: more fits no screen and no network.
constexpr double kMaxPixels = 2e7;

using Color = cv::Vec3b;  // red, green, blue

const Color kFree(245, 245, 245);
const Color kOccupied(20, 20, 20);
const Color kContradiction(205, 0, 0);
const Color kUnknown(112, 124, 142);
const Color kNoGrid(52, 54, 60);
const cv::Scalar kTitleBar(30, 32, 36);
const cv::Scalar kTitleText(235, 235, 235);
const cv::Scalar kVehicle(0, 110, 255);

constexpr double kTitleScale = 0.55;  // of OpenCV's font, which is 22 px high
constexpr int kTitleInset = 7;        // px, from the left and from the bottom

/// m; the vehicle is drawn as an arrowhead with the size of a car.
constexpr double kVehicleLength = 4.0;
constexpr double kVehicleWidth = 1.8;

/// Color by percent, the last one for unknown.
using Palette = std::array<Color, 102>;
constexpr std::size_t kUnknownSlot = 101;
constexpr double kMaxPercent = 100.0;

/// Cautious sensors contradict each other only weakly, which should be visible too.
constexpr double kConflictExponent = 0.5;

/// Colors from free to `full` at 100 percent; an `exponent` below 1 emphasizes small values.
Palette paletteTo(const Color& full, double exponent) {
  Palette palette;
  for (std::size_t percent = 0; percent < kUnknownSlot; ++percent) {
    const double share = std::pow(static_cast<double>(percent) / kMaxPercent, exponent);
    for (int channel = 0; channel < 3; ++channel) {
      palette[percent][channel] =
          cv::saturate_cast<std::uint8_t>((1.0 - share) * kFree[channel] + share * full[channel]);
    }
  }
  palette[kUnknownSlot] = kUnknown;
  return palette;
}

const Palette& paletteOf(const std::string& panel) {
  static const Palette kOccupancy = paletteTo(kOccupied, 1.0);
  static const Palette kContradictions = paletteTo(kContradiction, kConflictExponent);
  return panel == kConflict ? kContradictions : kOccupancy;
}

const Color& colorOf(Percent percent, const Palette& palette) {
  return palette[percent == kUnknownPercent ? kUnknownSlot : static_cast<std::size_t>(percent)];
}

void drawTitle(const std::string& text, cv::Mat bar) {
  bar.setTo(kTitleBar);
  cv::putText(bar, text, {kTitleInset, bar.rows - kTitleInset}, cv::FONT_HERSHEY_SIMPLEX,
              kTitleScale, kTitleText, 1, cv::LINE_AA);
}

}  // namespace

/// The area of the picture below the title, and the vehicle's position in it.
struct GridViews::Panel {
  cv::Mat image;
  double ahead = 0.0;    ///< m
  double to_side = 0.0;  ///< m
  double pixels_per_meter = 0.0;

  /// Center of a pixel in the vehicle's frame, m.
  Point2 pointAt(int row, int column) const {
    return {ahead - (row + 0.5) / pixels_per_meter, to_side - (column + 0.5) / pixels_per_meter};
  }

  cv::Point pixelAt(double x, double y) const {
    return {cvFloor((to_side - y) * pixels_per_meter), cvFloor((ahead - x) * pixels_per_meter)};
  }

  void drawCells(const SensorGrid& grid, const Pose2& base_in_grid, const Palette& palette) {
    const Point2 corner = base_in_grid * pointAt(0, 0);
    const Point2 along_row = base_in_grid.rotate({0.0, -1.0 / pixels_per_meter});
    const Point2 along_column = base_in_grid.rotate({-1.0 / pixels_per_meter, 0.0});
    for (int row = 0; row < image.rows; ++row) {
      const Point2 start = corner + row * along_column;
      auto* const pixels = image.ptr<Color>(row);
      for (int column = 0; column < image.cols; ++column) {
        const CellIndex cell = grid.window().cellAt(start + column * along_row);
        pixels[column] = colorOf(grid.atOrUnknown(cell), palette);
      }
    }
  }

  void drawVehicle() {
    const double x = 0.5 * kVehicleLength;
    const double y = 0.5 * kVehicleWidth;
    const std::array<cv::Point, 3> arrowhead = {pixelAt(x, 0.0), pixelAt(-x, y), pixelAt(-x, -y)};
    cv::fillConvexPoly(image, arrowhead.data(), static_cast<int>(arrowhead.size()), kVehicle,
                       cv::LINE_AA);
  }
};

GridViews::GridViews(const Checked<GridViewsOptions>& options)
    : options_(*options), panels_(options->panelNames()) {
  const auto pixels = [&options](double meters) {
    return static_cast<int>(std::lround(meters * options->pixels_per_meter));
  };
  panel_width_ = pixels(2.0 * options->to_side);
  panel_height_ = pixels(options->ahead + options->behind);
  const double max = kMaxPixels / static_cast<double>(panels_.size());
  if (static_cast<double>(panel_width_) * panel_height_ > max) {
    throw OptionError("pixels_per_meter = " + std::to_string(options->pixels_per_meter) +
                      " gives panels of " + std::to_string(panel_width_) + " x " +
                      std::to_string(panel_height_) + " pixels: expected fewer than " +
                      std::to_string(std::lround(max)) + " in each");
  }
}

void GridViews::handleGrid(const std::string& panel, const nav_msgs::OccupancyGridConstPtr& grid) {
  const Stamp stamp = toStamp(grid->header.stamp);
  if (panel != kMap) {
    if (newest_ && secondsBetween(stamp, *newest_) > options_.silent_after) {
      grids_.clear();
      pose_.reset();
      newest_.reset();
    }
    newest_ = newest_ ? std::max(*newest_, stamp) : stamp;
  }
  grids_[panel] = grid;
  last_ = grid->header;
}

sensor_msgs::ImagePtr GridViews::draw() const {
  const int step = panel_width_ + kGap;
  auto message = boost::make_shared<sensor_msgs::Image>();
  message->header = last_;
  message->encoding = sensor_msgs::image_encodings::RGB8;
  message->width = static_cast<std::uint32_t>(step * static_cast<int>(panels_.size()) - kGap);
  message->height = static_cast<std::uint32_t>(kTitleHeight + panel_height_);
  message->step = message->width * static_cast<std::uint32_t>(sizeof(Color));
  message->data.resize(std::size_t{message->step} * message->height);
  cv::Mat image(static_cast<int>(message->height), static_cast<int>(message->width), CV_8UC3,
                message->data.data());
  image.setTo(kTitleBar);
  int left = 0;
  for (const std::string& name : panels_) {
    const cv::Mat below = image({left, kTitleHeight, panel_width_, panel_height_});
    Panel panel{below, options_.ahead, options_.to_side, options_.pixels_per_meter};
    const std::string problem = drawGrid(name, panel);
    panel.drawVehicle();
    drawTitle(problem.empty() ? name : name + ": " + problem,
              image({left, 0, panel_width_, kTitleHeight}));
    left += step;
  }
  return message;
}

/// Returns what is wrong with the grid; empty if it was drawn.
std::string GridViews::drawGrid(const std::string& name, Panel& panel) const {
  try {
    panel.drawCells(fromMessage(gridOf(name)), baseInGrid(name), paletteOf(name));
    return "";
  } catch (const InputError& error) {
    panel.image.setTo(kNoGrid);
    return error.reason();
  }
}

const nav_msgs::OccupancyGrid& GridViews::gridOf(const std::string& name) const {
  const auto found = grids_.find(name);
  if (found == grids_.end()) {
    throw InputError("no grid", "no grid of " + name + " received");
  }
  const nav_msgs::OccupancyGrid& grid = *found->second;
  if (name != kMap &&
      secondsBetween(toStamp(grid.header.stamp), *newest_) > options_.silent_after) {
    throw InputError("silent", "the last grid of " + name + " is too old");
  }
  return grid;
}

Pose2 GridViews::baseInGrid(const std::string& name) const {
  if (name != kMap) {
    return {};
  }
  if (!pose_) {
    throw InputError("no pose", "no pose in the map received");
  }
  return fromMessage(pose_->pose.pose);
}

}  // namespace datmo
