// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Geometry>
#include <opencv2/core.hpp>

#include "datmo_fusion/common/pose2.h"
#include "datmo_fusion/vision/image_region.h"
#include "datmo_fusion/vision/road_color.h"

namespace datmo {

/// The ground as a camera sees it: which pixels show which cell.
class GroundView {
 public:
  explicit GroundView(const MountedCamera& camera);

  /// Over ground, m, base frame.
  const Point2& position() const { return position_; }
  /// Of the camera above the road, m.
  double height() const { return height_; }
  /// Whether it sees the road at all: it is above it and does not look straight up or down.
  bool seesRoad() const;

  /// Directions (unit vectors, base frame) of lines of sight over the image's width, right to left,
  /// by which two neighbors at `range` (m) are at most `spacing` (m) apart.
  std::vector<Point2> directions(double range, double spacing) const;

  /// The pixels of a square on the road with sides of `size` (m) along and across its line of
  /// sight, and of what stands on it up to `height` (m). None where not all of it is in the image.
  std::optional<cv::Rect> patch(const Point2& center, double size, double height = 0.0) const;

  /// Of a point in the base frame. None behind the camera and beside the image.
  std::optional<cv::Point> pixel(const Eigen::Vector3d& point) const;

 private:
  std::optional<Eigen::Vector2d> project(const Eigen::Vector3d& point) const;

  MountedCamera camera_;
  Eigen::Isometry3d base_in_camera_;
  Point2 position_;
  double height_;
};

/// The color of a pixel of an 8 bit image, gray or BGR, in it.
PixelColor colorAt(const cv::Mat& image, const cv::Point& pixel);

/// How much of any part of an image is of the road's colors.
class RoadPixels {
 public:
  /// `image`: 8 bit, gray or BGR; `color` must have learned that many channels.
  RoadPixels(const cv::Mat& image, const RoadColor& color);

  /// 0 to 1. `patch`: in the image, not empty.
  double share(const cv::Rect& patch) const;

 private:
  cv::Mat sums_;  ///< integral image of the road's pixels
};

}  // namespace datmo
