// SPDX-License-Identifier: BSD-3-Clause
#include "stereo_street.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>

#include "datmo_fusion/common/random.h"

namespace datmo {

namespace {

constexpr int kWidth = 640;             // px
constexpr int kHeight = 480;            // px: 307,200 points
constexpr std::size_t kPointStep = 32;  // bytes: x, y, z, rgb and padding

StereoCloud streetView() {
  StereoCloud cloud;
  cloud.camera = {480.0, 0.34, DepthNoise::ofDisparity(480.0, 0.34, 0.25), -0.5 * kWidth / 480.0,
                  0.5 * kWidth / 480.0};
  cloud.camera_in_base.linear() << 0.0, 0.0, 1.0, -1.0, 0.0, 0.0, 0.0, -1.0, 0.0;
  cloud.camera_in_base.translation() = Eigen::Vector3d(1.8, 0.0, 1.3);
  cloud.scanner_height = 0.33;
  return cloud;
}

/// Depth (m) in a street: road, facades on both sides and at its end, a car.
double depthAlong(double right, double down, double camera_height) {
  double depth = std::min(40.0, 8.0 / std::max(std::abs(right), 1e-6));
  if (down > 0.0) {
    depth = std::min(depth, camera_height / down);
  }
  const double car = 12.0;
  const bool on_car = std::abs(right * car) < 0.9 && std::abs(down * car - 0.5) < 0.7;
  return on_car ? std::min(depth, car) : depth;
}

/// The points of the image with noise, 1 in 5 without depth.
std::vector<std::uint8_t> streetPoints(const StereoCloud& cloud) {
  Random random(1);
  std::vector<std::uint8_t> memory(kPointStep * kWidth * kHeight, 0);
  const StereoCamera& camera = cloud.camera;
  std::uint8_t* point = memory.data();
  for (int row = 0; row < kHeight; ++row) {
    for (int column = 0; column < kWidth; ++column, point += kPointStep) {
      const double right = (column - 0.5 * kWidth) / camera.focal_length;
      const double down = (row - 0.5 * kHeight) / camera.focal_length;
      const double depth = depthAlong(right, down, cloud.camera_in_base.translation().z());
      const double off = depth + random.normal(camera.depthSigma(depth));
      const double seen = random.chance(0.2) ? std::numeric_limits<double>::quiet_NaN() : off;
      const float position[] = {static_cast<float>(right * seen), static_cast<float>(down * seen),
                                static_cast<float>(seen)};
      std::memcpy(point, position, sizeof(position));
    }
  }
  return memory;
}

/// A message whose points are in `memory`.
PointsView pointsIn(const std::vector<std::uint8_t>& memory) {
  PointsView points;
  points.data = memory.data();
  points.step = kPointStep;
  points.count = memory.size() / kPointStep;
  return points;
}

}  // namespace

StereoStreet::StereoStreet() : cloud_(streetView()), memory_(streetPoints(cloud_)) {
  cloud_.points = pointsIn(memory_);
}

}  // namespace datmo
