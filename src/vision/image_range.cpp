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

constexpr double kBorder = 2.0;  ///< px: an edge this close to the image's border was cut by it

// Standard deviations over all headings (rectangles with these sizes), as shares of an object's
// width: distance of the middle of its near side behind its nearest corner, which is at the
// rectangle's lower edge, and distance of an end of that side inside the rectangle.
constexpr double kNearCorner = 0.25;
constexpr double kNearEnd = 0.35;

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

/// px, standard deviation of the rectangle's upper and lower edges.
double edgeSigma(const Eigen::AlignedBox2d& box, const ImageRangeOptions& options) {
  return std::hypot(options.edge_sigma, options.edge_share * box.sizes().y());
}

/// px, the same for its left and right edges.
double sideEdgeSigma(const Eigen::AlignedBox2d& box, const ImageRangeOptions& options) {
  return std::hypot(options.edge_sigma, options.edge_share * box.sizes().x());
}

/// Line of sight of a pixel, in the base frame, scaled to a depth of 1 m.
Eigen::Vector3d rayOf(const MountedCamera& camera, double column, double row) {
  const PinholeCamera& p = camera.pinhole;
  return camera.in_base.linear() *
         Eigen::Vector3d((column - p.center_x) / p.focal_x, (row - p.center_y) / p.focal_y, 1.0);
}

/// The line of sight to the middle of the rectangle's lower edge.
Eigen::Vector3d rayToFoot(const MountedCamera& camera, const Eigen::AlignedBox2d& box) {
  return rayOf(camera, box.center().x(), box.max().y());
}

/// A range by one of the two methods, and how much nearer it becomes per pixel that the rectangle's
/// lower edge is lower (m/px): both depend on that edge.
struct RangeByEdge {
  ImageRange range;
  double per_pixel = 0.0;
};

std::optional<RangeByEdge> rangeBySize(const MountedCamera& camera, const ImageDetection& detection,
                                       const ImageRangeOptions& options) {
  const Eigen::AlignedBox2d& box = detection.box;
  if (box.min().y() < kBorder) {
    return std::nullopt;
  }
  const ClassSize size = sizeOf(detection.object_class);
  const double pixels = box.sizes().y();
  const double depth = camera.pinhole.focal_y * size.height / pixels;
  const double range = depth * rayToFoot(camera, box).head<2>().norm();
  const double share = std::hypot(size.height_sigma / size.height,
                                  std::sqrt(2.0) * edgeSigma(box, options) / pixels);
  return RangeByEdge{{range, range * share}, range / pixels};
}

std::optional<RangeByEdge> rangeByGround(const MountedCamera& camera,
                                         const ImageDetection& detection,
                                         const ImageRangeOptions& options) {
  const Eigen::AlignedBox2d& box = detection.box;
  const Eigen::Vector3d ray = rayToFoot(camera, box);
  const double height = camera.in_base.translation().z();
  if (ray.z() >= 0.0 || height <= 0.0) {
    return std::nullopt;  // above the horizon
  }
  const double range = -height / ray.z() * ray.head<2>().norm();
  const double per_angle = (square(range) + square(height)) / height;
  const double per_pixel = per_angle / camera.pinhole.focal_y;
  const double sigma =
      std::hypot(per_angle * options.pitch_sigma, per_pixel * edgeSigma(box, options));
  return RangeByEdge{{range, sigma}, per_pixel};
}

/// Least squares with the common error from the lower edge, with weights limited to 0 and above.
ImageRange fused(const RangeByEdge& a, const RangeByEdge& b, double edge_sigma) {
  const double variance_a = square(a.range.sigma);
  const double variance_b = square(b.range.sigma);
  const double common = a.per_pixel * b.per_pixel * square(edge_sigma);
  const double of_difference = variance_a + variance_b - 2.0 * common;
  const double weight_a = std::clamp((variance_b - common) / of_difference, 0.0, 1.0);
  const double weight_b = 1.0 - weight_a;
  const double variance = square(weight_a) * variance_a + square(weight_b) * variance_b +
                          2.0 * weight_a * weight_b * common;
  const double contradiction = std::max(1.0, square(a.range.range - b.range.range) / of_difference);
  return {weight_a * a.range.range + weight_b * b.range.range, std::sqrt(contradiction * variance)};
}

/// Whether a pixel of a rectangle is occluded by something nearer, whose rectangle reaches farther
/// down.
bool isCovered(const Eigen::AlignedBox2d& box, const Eigen::Vector2d& pixel,
               const std::vector<ImageDetection>& seen, const ImageRangeOptions& options) {
  return std::any_of(seen.begin(), seen.end(), [&](const ImageDetection& other) {
    const double nearer = other.box.max().y() - box.max().y();
    const double beside = other.box.exteriorDistance(pixel);
    return nearer > std::hypot(edgeSigma(box, options), edgeSigma(other.box, options)) &&
           beside <= sideEdgeSigma(other.box, options);
  });
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
                  "standard deviation of a rectangle's edges, as a share of its height, or width "
                  "for the sides"},
                 edge_share, {0.0, 1.0});
  visitor.number(
      {"edge_sigma", "px", "the part of it that does not depend on the size, added in quadrature"},
      edge_sigma, {0.1, 100.0});
  visitor.number({"pitch_sigma", "rad",
                  "standard deviation of the camera's pitch over the road: springs and slopes"},
                 pitch_sigma, {0.0001, 0.2});
  visitor.number(
      {"max_range", "m", "detections from the image alone that are farther away are not reported"},
      max_range, {1.0, 500.0});
}

std::optional<ImageRange> rangeOf(const MountedCamera& camera, const ImageDetection& detection,
                                  const ImageRangeOptions& options) {
  const Eigen::AlignedBox2d& box = detection.box;
  if (box.isEmpty() || box.volume() <= 0.0 || box.max().y() > camera.height - kBorder) {
    return std::nullopt;
  }
  const auto by_size = rangeBySize(camera, detection, options);
  const auto by_ground = rangeByGround(camera, detection, options);
  if (!by_size && !by_ground) {
    return std::nullopt;
  }
  const ImageRange result = by_size && by_ground
                                ? fused(*by_size, *by_ground, edgeSigma(box, options))
                                : (by_size ? by_size : by_ground)->range;
  return result.range <= options.max_range ? std::optional(result) : std::nullopt;
}

std::optional<Object> objectOf(const MountedCamera& camera, const ImageDetection& detection,
                               const ImageRangeOptions& options,
                               const std::vector<ImageDetection>& seen) {
  const auto near = rangeOf(camera, detection, options);
  const Eigen::AlignedBox2d& box = detection.box;
  if (!near || isCovered(box, {box.center().x(), box.max().y()}, seen, options)) {
    return std::nullopt;
  }
  const ClassSize size = sizeOf(detection.object_class);
  const Point2 ahead = rayToFoot(camera, box).head<2>().normalized();
  const double per_pixel = near->range / camera.pinhole.focal_x;  // m
  const double across = per_pixel * box.sizes().x();
  // For any heading, it extends as far behind its near side as it is wide.
  Object object;
  object.box = {
      Pose2(camera.in_base.translation().head<2>() + (near->range + 0.5 * size.width) * ahead,
            std::atan2(ahead.y(), ahead.x())),
      size.width, across};
  const double edge_sigma = per_pixel * sideEdgeSigma(box, options);
  const Point2 aside = perpendicular(ahead);
  // Half of each edge's error moves the rectangle as a whole.
  object.position_covariance = square(near->sigma) * ahead * ahead.transpose() +
                               0.5 * square(edge_sigma) * aside * aside.transpose();
  const double side = 0.5 * square(edge_sigma) + square(kNearEnd * size.width) +
                      square(0.5 * across * near->sigma / near->range);
  const auto of_edge = [&](double column) {
    const bool is_cut = column < kBorder || column > camera.width - kBorder ||
                        isCovered(box, {column, box.center().y()}, seen, options);
    return is_cut ? kHiddenSide : side;
  };
  object.side_variance = {kHiddenSide, square(kNearCorner * size.width), of_edge(box.min().x()),
                          of_edge(box.max().x())};
  object.height = size.height;
  return object;
}

}  // namespace datmo
