// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/vision/image_range.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "datmo_fusion/common/perpendicular.h"
#include "datmo_fusion/common/square.h"
#include "datmo_fusion/detection/object_classifier.h"

namespace datmo {

namespace {

constexpr double kBorder = 2.0;  ///< px: an edge this near to the image's border was cut by it

/// Mean and standard deviation of a mixture of vehicles.
struct Mixture {
  double share = 0.0, sum = 0.0, squares = 0.0;

  void add(double weight, double mean, double sigma) {
    share += weight;
    sum += weight * mean;
    squares += weight * (square(mean) + square(sigma));
  }
  double mean() const { return sum / share; }
  double sigma() const { return std::sqrt(std::max(0.0, squares / share - square(mean()))); }
};

ClassSize sizeOfVehicles(const std::vector<KindSize>& kinds) {
  Mixture length;
  Mixture width;
  Mixture height;
  for (const KindSize& kind : kinds) {
    length.add(kind.share, kind.length, kind.length_sigma);
    width.add(kind.share, kind.width, kind.width_sigma);
    height.add(kind.share, kind.height, kind.height_sigma);
  }
  return {length.mean(), length.sigma(), width.mean(),
          width.sigma(), height.mean(),  height.sigma()};
}

ClassSize sizeOfKind(const KindSize& kind) {
  return {kind.length,      kind.length_sigma, kind.width,
          kind.width_sigma, kind.height,       kind.height_sigma};
}

/// px, standard deviation of an edge of the rectangle.
double edgeSigma(const Eigen::AlignedBox2d& box, const ImageRangeOptions& options) {
  return std::hypot(options.edge_sigma, options.edge_share * box.sizes().y());
}

std::optional<ImageRange> rangeBySize(const MountedCamera& camera, const ImageDetection& detection,
                                      const ImageRangeOptions& options) {
  const Eigen::AlignedBox2d& box = detection.box;
  if (box.min().y() < kBorder) {
    return std::nullopt;
  }
  const ClassSize size = sizeOf(detection.object_class);
  const double pixels = box.sizes().y();
  const double range = camera.pinhole.focal_y * size.height / pixels;
  const double share = std::hypot(size.height_sigma / size.height,
                                  std::sqrt(2.0) * edgeSigma(box, options) / pixels);
  return ImageRange{range, range * share};
}

/// Line of sight of a pixel, in the base frame.
Eigen::Vector3d rayOf(const MountedCamera& camera, double column, double row) {
  const PinholeCamera& p = camera.pinhole;
  return camera.in_base.linear() *
         Eigen::Vector3d((column - p.center_x) / p.focal_x, (row - p.center_y) / p.focal_y, 1.0);
}

std::optional<ImageRange> rangeByGround(const MountedCamera& camera,
                                        const ImageDetection& detection,
                                        const ImageRangeOptions& options) {
  const Eigen::AlignedBox2d& box = detection.box;
  const Eigen::Vector3d ray = rayOf(camera, box.center().x(), box.max().y());
  const double height = camera.in_base.translation().z();
  if (ray.z() >= 0.0 || height <= 0.0) {
    return std::nullopt;  // above the horizon
  }
  const double range = -height / ray.z() * ray.head<2>().norm();
  const double angle =
      std::hypot(options.pitch_sigma, edgeSigma(box, options) / camera.pinhole.focal_y);
  return ImageRange{range, angle * (square(range) + square(height)) / height};
}

ImageRange fused(const ImageRange& a, const ImageRange& b) {
  const double variance_a = square(a.sigma);
  const double variance_b = square(b.sigma);
  const double sum = variance_a + variance_b;
  const double contradiction = std::max(1.0, square(a.range - b.range) / sum);
  return {(variance_b * a.range + variance_a * b.range) / sum,
          std::sqrt(contradiction * variance_a * variance_b / sum)};
}

}  // namespace

ClassSize sizeOf(ObjectClass object_class) {
  const ObjectClassifierOptions kinds;
  switch (object_class) {
    case ObjectClass::kPedestrian:
      return sizeOfKind(kinds.pedestrian);
    case ObjectClass::kCyclist:
      return sizeOfKind(kinds.cyclist);
    case ObjectClass::kVehicle:
      return sizeOfVehicles({kinds.car, kinds.van, kinds.truck});
    case ObjectClass::kUnknown:
    case ObjectClass::kPole:
      break;
  }
  throw std::invalid_argument(std::string("size of class ") + nameOf(object_class) +
                              ": expected pedestrian, cyclist or vehicle");
}

void ImageRangeOptions::visit(OptionVisitor& visitor) {
  visitor.number({"edge_share", "1",
                  "standard deviation of a rectangle's upper and lower edge, of its height"},
                 edge_share, {0.0, 1.0});
  visitor.number({"edge_sigma", "px", "the same that small rectangles have as well"}, edge_sigma,
                 {0.1, 100.0});
  visitor.number({"pitch_sigma", "rad",
                  "standard deviation of the camera's pitch over the road: springs and slopes"},
                 pitch_sigma, {0.0001, 0.2});
  visitor.number({"max_range", "m", "what the image alone sees farther away is not reported"},
                 max_range, {1.0, 500.0});
}

std::optional<ImageRange> rangeOf(const MountedCamera& camera, const ImageDetection& detection,
                                  const ImageRangeOptions& options) {
  const Eigen::AlignedBox2d& box = detection.box;
  if (box.isEmpty() || box.volume() <= 0.0 || box.max().y() > camera.height - kBorder) {
    return std::nullopt;
  }
  std::optional<ImageRange> result = rangeBySize(camera, detection, options);
  if (const auto by_ground = rangeByGround(camera, detection, options)) {
    result = result ? fused(*result, *by_ground) : *by_ground;
  }
  return result && result->range <= options.max_range ? result : std::nullopt;
}

std::optional<Object> objectOf(const MountedCamera& camera, const ImageDetection& detection,
                               const ImageRangeOptions& options) {
  const auto near = rangeOf(camera, detection, options);
  if (!near) {
    return std::nullopt;
  }
  const ClassSize size = sizeOf(detection.object_class);
  const Eigen::AlignedBox2d& box = detection.box;
  const Point2 ahead = rayOf(camera, box.center().x(), box.max().y()).head<2>().normalized();
  // Its center is half a width to half a length behind its near side, by how it is turned.
  const double behind = 0.25 * (size.length + size.width);
  const double depth_sigma = std::hypot(near->sigma, 0.25 * (size.length - size.width));
  const double side_sigma = near->range *
                            std::hypot(options.edge_sigma, options.edge_share * box.sizes().x()) /
                            camera.pinhole.focal_x;
  Object object;
  object.box = {Pose2(camera.in_base.translation().head<2>() + (near->range + behind) * ahead,
                      std::atan2(ahead.y(), ahead.x())),
                size.length, size.width};
  const Point2 aside = perpendicular(ahead);
  object.position_covariance = square(depth_sigma) * ahead * ahead.transpose() +
                               square(side_sigma) * aside * aside.transpose();
  const double across = square(0.5 * size.width_sigma);
  const double along = square(0.5 * size.length_sigma);
  object.side_variance = {along, along, across, across};
  object.height = size.height;
  object.object_class = detection.object_class;
  return object;
}

}  // namespace datmo
