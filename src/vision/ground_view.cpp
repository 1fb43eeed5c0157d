// SPDX-License-Identifier: BSD-3-Clause
#include "ground_view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include <opencv2/imgproc.hpp>

#include "datmo_fusion/common/log_odds.h"
#include "datmo_fusion/common/perpendicular.h"

namespace datmo {

namespace {

constexpr int kLevels = 256;   ///< of a channel
constexpr int kColorStep = 8;  ///< size of a color cube that shares one probability
constexpr int kColorBins = kLevels / kColorStep;

/// Minimum cosine of the axis's pitch: a steeper camera sees no usable horizon.
constexpr double kMinLevel = 0.2;

float evidenceOf(const RoadColor& color, const PixelColor& pixel) {
  return static_cast<float>(logOddsOf(color.probability(pixel)));
}

cv::Mat evidenceOfGray(const cv::Mat& image, const RoadColor& color) {
  cv::Mat table(1, kLevels, CV_32FC1);
  for (int level = 0; level < kLevels; ++level) {
    table.at<float>(level) = evidenceOf(color, PixelColor::Constant(1, level));
  }
  cv::Mat evidence;
  cv::LUT(image, table, evidence);
  return evidence;
}

std::size_t binOf(const cv::Vec3b& pixel) {
  const auto bin = [&](int channel) {
    return static_cast<std::size_t>(pixel[channel] / kColorStep);
  };
  constexpr std::size_t kBins = kColorBins;
  return (bin(0) * kBins + bin(1)) * kBins + bin(2);
}

cv::Mat evidenceOfColor(const cv::Mat& image, const RoadColor& color) {
  const auto middle = [](int bin) { return (bin + 0.5) * kColorStep; };
  std::vector<float> table;
  for (int blue = 0; blue < kColorBins; ++blue) {
    for (int green = 0; green < kColorBins; ++green) {
      for (int red = 0; red < kColorBins; ++red) {
        PixelColor pixel(3);
        pixel << middle(blue), middle(green), middle(red);
        table.push_back(evidenceOf(color, pixel));
      }
    }
  }
  cv::Mat evidence(image.size(), CV_32FC1);
  for (int row = 0; row < image.rows; ++row) {
    const auto* from = image.ptr<cv::Vec3b>(row);
    std::transform(from, from + image.cols, evidence.ptr<float>(row),
                   [&table](const cv::Vec3b& pixel) { return table[binOf(pixel)]; });
  }
  return evidence;
}

}  // namespace

GroundView::GroundView(const MountedCamera& camera)
    : camera_(camera),
      base_in_camera_(camera.in_base.inverse()),
      position_(camera.in_base.translation().head<2>()),
      height_(camera.in_base.translation().z()) {}

bool GroundView::seesRoad() const {
  return height_ > 0.0 && camera_.in_base.linear().col(2).head<2>().norm() >= kMinLevel;
}

std::vector<Point2> GroundView::directions(double range, double spacing) const {
  const Point2 ahead = camera_.in_base.linear().col(2).head<2>();
  const double heading = std::atan2(ahead.y(), ahead.x());
  const PinholeCamera& p = camera_.pinhole;
  const double right = heading - std::atan((camera_.width - p.center_x) / p.focal_x);
  const double left = heading + std::atan(p.center_x / p.focal_x);
  const int steps = 1 + static_cast<int>(std::ceil((left - right) * range / spacing));
  std::vector<Point2> directions;
  for (int step = 0; step <= steps; ++step) {
    const double angle = right + (left - right) * step / steps;
    directions.emplace_back(std::cos(angle), std::sin(angle));
  }
  return directions;
}

std::optional<Eigen::Vector2d> GroundView::project(const Eigen::Vector3d& point) const {
  const Eigen::Vector3d seen = base_in_camera_ * point;
  if (seen.z() < kNearestDepth) {
    return std::nullopt;
  }
  const PinholeCamera& p = camera_.pinhole;
  const Eigen::Vector2d pixel(p.focal_x * seen.x() / seen.z() + p.center_x,
                              p.focal_y * seen.y() / seen.z() + p.center_y);
  const bool inside = pixel.x() >= 0.0 && pixel.y() >= 0.0 && pixel.x() < camera_.width &&
                      pixel.y() < camera_.height;
  return inside ? std::make_optional(pixel) : std::nullopt;
}

std::optional<cv::Point> GroundView::pixel(const Eigen::Vector3d& point) const {
  const auto pixel = project(point);
  return pixel ? std::make_optional(
                     cv::Point(static_cast<int>(pixel->x()), static_cast<int>(pixel->y())))
               : std::nullopt;
}

std::optional<cv::Rect> GroundView::patch(const Point2& center, double size, double height) const {
  const Point2 along = 0.5 * size * (center - position_).normalized();
  const Point2 across = perpendicular(along);
  const std::array<Eigen::Vector3d, 5> points = {
      Eigen::Vector3d(center.x() + along.x(), center.y() + along.y(), 0.0),
      Eigen::Vector3d(center.x() - along.x(), center.y() - along.y(), 0.0),
      Eigen::Vector3d(center.x() + across.x(), center.y() + across.y(), 0.0),
      Eigen::Vector3d(center.x() - across.x(), center.y() - across.y(), 0.0),
      Eigen::Vector3d(center.x(), center.y(), height)};
  cv::Rect patch;
  for (const Eigen::Vector3d& point : points) {
    const auto at = pixel(point);
    if (!at) {
      return std::nullopt;
    }
    patch |= cv::Rect(at->x, at->y, 1, 1);
  }
  return patch;
}

PixelColor colorAt(const cv::Mat& image, const cv::Point& pixel) {
  if (image.channels() == 1) {
    return PixelColor::Constant(1, image.at<std::uint8_t>(pixel));
  }
  const auto& bgr = image.at<cv::Vec3b>(pixel);
  PixelColor color(3);
  color << bgr[0], bgr[1], bgr[2];
  return color;
}

RoadPixels::RoadPixels(const cv::Mat& image, const RoadColor& color) {
  cv::integral(image.channels() == 1 ? evidenceOfGray(image, color) : evidenceOfColor(image, color),
               sums_, CV_64F);
}

double RoadPixels::evidence(const cv::Rect& patch) const {
  const cv::Point end = patch.br();
  const double sum = sums_.at<double>(end) - sums_.at<double>(patch.y, end.x) -
                     sums_.at<double>(end.y, patch.x) + sums_.at<double>(patch.tl());
  return sum / patch.area();
}

}  // namespace datmo
