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

/// A camera's view of the ground: which pixels show which cell.
class GroundView {
 public:
  explicit GroundView(const MountedCamera& camera);

  /// Horizontal position, m, base frame.
  const Point2& position() const { return position_; }
  /// Height of the camera above the road, m.
  double height() const { return height_; }
  /// Whether it sees the road at all: it is above it and does not look straight up or down.
  bool seesRoad() const;

  /// Returns the directions (unit vectors, base frame) of lines of sight across the image, right to
  /// left, such that neighbors are at most `spacing` (m) apart at `range` (m).
  std::vector<Point2> directions(double range, double spacing) const;

  /// Returns the pixels of a square on the road with sides of `size` (m) along and across its line
  /// of sight, and of objects on it up to `height` (m). None unless it is entirely in the image.
  std::optional<cv::Rect> patch(const Point2& center, double size, double height = 0.0) const;

  /// Returns the pixel of a point in the base frame. None behind the camera and beside the image.
  std::optional<cv::Point> pixel(const Eigen::Vector3d& point) const;

 private:
  std::optional<Eigen::Vector2d> project(const Eigen::Vector3d& point) const;

  MountedCamera camera_;
  Eigen::Isometry3d base_in_camera_;
  Point2 position_;
  double height_;
};

/// Returns the color of a pixel of an 8 bit image, gray or BGR.
PixelColor colorAt(const cv::Mat& image, const cv::Point& pixel);

/// What the colors of any part of an image say about whether it is road.
class RoadPixels {
 public:
  /// `image`: 8 bit, gray or BGR; `color` must have learned that many channels.
  RoadPixels(const cv::Mat& image, const RoadColor& color);

  /// Returns the mean log-likelihood ratio, road : other, of the pixels of a patch: neighboring
  /// pixels are of the same surface, and together say no more than one. `patch`: in the image, not
  /// empty.
  double evidence(const cv::Rect& patch) const;

 private:
  cv::Mat sums_;  ///< integral image of the pixels' log-likelihood ratios
};

}  // namespace datmo
