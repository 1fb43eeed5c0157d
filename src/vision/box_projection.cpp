// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/vision/box_projection.h"

#include <array>
#include <cstddef>
#include <optional>
#include <utility>

namespace datmo {

namespace {

constexpr std::size_t kCorners = 8;
using Corners = std::array<Eigen::Vector3d, kCorners>;

/// The edges by their corner indices.
constexpr std::array<std::pair<std::size_t, std::size_t>, 12> kEdges = {{
    {0, 1},
    {1, 2},
    {2, 3},
    {3, 0},  // bottom
    {4, 5},
    {5, 6},
    {6, 7},
    {7, 4},  // top
    {0, 4},
    {1, 5},
    {2, 6},
    {3, 7},  // upright
}};

/// In the camera's frame, m: around the bottom, then around the top.
Corners cornersOf(const Box3& box) {
  const double x = 0.5 * box.size.x();
  const double y = 0.5 * box.size.y();
  const double z = box.size.z();
  const Corners in_box = {{{x, y, 0.0},
                           {-x, y, 0.0},
                           {-x, -y, 0.0},
                           {x, -y, 0.0},
                           {x, y, z},
                           {-x, y, z},
                           {-x, -y, z},
                           {x, -y, z}}};
  Corners corners;
  for (std::size_t i = 0; i < kCorners; ++i) {
    corners[i] = box.pose * in_box[i];
  }
  return corners;
}

/// Clips a segment to the part at least `near` ahead of the camera.
std::optional<std::pair<Eigen::Vector3d, Eigen::Vector3d>> cutNear(Eigen::Vector3d from,
                                                                   Eigen::Vector3d to,
                                                                   double near) {
  if (from.z() < near && to.z() < near) {
    return std::nullopt;
  }
  const auto cut = [near](const Eigen::Vector3d& behind, const Eigen::Vector3d& ahead) {
    const double share = (near - behind.z()) / (ahead.z() - behind.z());
    return Eigen::Vector3d(behind + share * (ahead - behind));
  };
  if (from.z() < near) {
    from = cut(from, to);
  } else if (to.z() < near) {
    to = cut(to, from);
  }
  return std::pair(from, to);
}

Eigen::Vector2d pixelOf(const PinholeCamera& camera, const Eigen::Vector3d& point) {
  return {camera.focal_x * point.x() / point.z() + camera.center_x,
          camera.focal_y * point.y() / point.z() + camera.center_y};
}

}  // namespace

std::vector<ImageSegment> projectBox(const PinholeCamera& camera, const Box3& box_in_camera,
                                     double near) {
  const Corners corners = cornersOf(box_in_camera);
  std::vector<ImageSegment> segments;
  for (const auto& [from, to] : kEdges) {
    if (const auto edge = cutNear(corners[from], corners[to], near)) {
      segments.push_back({pixelOf(camera, edge->first), pixelOf(camera, edge->second)});
    }
  }
  return segments;
}

Eigen::AlignedBox2d boundsInImage(const std::vector<ImageSegment>& segments, double width,
                                  double height) {
  Eigen::AlignedBox2d bounds;
  for (const ImageSegment& segment : segments) {
    bounds.extend(segment.from);
    bounds.extend(segment.to);
  }
  return bounds.intersection(
      Eigen::AlignedBox2d(Eigen::Vector2d::Zero(), Eigen::Vector2d(width, height)));
}

}  // namespace datmo
