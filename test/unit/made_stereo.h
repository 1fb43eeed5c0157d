// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "datmo_fusion/common/random.h"
#include "datmo_fusion/sensor_model/stereo_cloud.h"

namespace datmo {

/// An upright box on the ground, sides along the axes; m.
struct MadeBox {
  Eigen::Vector3d min, max;
};

/// A piece of road without texture: no disparity is found there; m.
struct MadeHole {
  double begin = 0.0, end = 0.0;  ///< along x, all across
};

/// The scene of a stereo camera, and how it is measured. The road is z = 0.
struct MadeScene {
  std::vector<MadeBox> boxes;
  std::optional<MadeHole> hole;
  double camera_height = 1.2;    ///< m
  double camera_yaw = 0.0;       ///< rad, to the left
  double unknown_pitch = 0.0;    ///< rad, downward; unknown to the mount in the cloud
  double disparity_noise = 0.0;  ///< px, standard deviation
  double disparity_bias = 0.0;   ///< px, of all points
  /// For a depth camera without baseline, in place of that of disparities.
  std::optional<DepthNoise> depth_noise;
  double depth_bias = 0.0;  ///< of a depth camera's points, standard deviations of the depth
  std::uint64_t seed = 3;   ///< of the noise
  int step = 1;             ///< px from a point to the next one, both ways
};

/// A cloud and the memory of its points.
class MadeCloud {
 public:
  MadeCloud() {
    cloud_.stamp = Stamp::fromSeconds(7.0);
    cloud_.camera = {400.0, 0.5, DepthNoise::ofDisparity(400.0, 0.5, 0.25), -0.5, 0.5};
    cloud_.scanner_height = 0.33;
    mount(1.2, 0.0, 0.0);
  }

  explicit MadeCloud(const MadeScene& scene) : MadeCloud() {
    mount(scene.camera_height, scene.camera_yaw, scene.unknown_pitch);
    const Eigen::Isometry3d true_mount = cloud_.camera_in_base;
    mount(scene.camera_height, scene.camera_yaw, 0.0);
    if (scene.depth_noise) {
      cloud_.camera.baseline = 0.0;
      cloud_.camera.noise = *scene.depth_noise;
    }
    Random random(scene.seed);
    for (int row = -kHalfHeight; row < kHalfHeight; row += scene.step) {
      for (int column = -kHalfWidth; column < kHalfWidth; column += scene.step) {
        const double focal_length = cloud_.camera.focal_length;
        const Eigen::Vector3d direction((column + 0.5) / focal_length, (row + 0.5) / focal_length,
                                        1.0);
        const double depth = depthAlong(true_mount * direction, true_mount.translation(), scene);
        add(direction * measured(depth, scene, random));
      }
    }
  }

  /// `optical`: m; not a number where there is no depth.
  void add(const Eigen::Vector3d& optical) {
    for (const double coordinate : {optical.x(), optical.y(), optical.z(), 0.0}) {
      memory_.push_back(static_cast<float>(coordinate));
    }
  }

  /// `position`: base frame, m.
  void addAt(const Eigen::Vector3d& position) { add(cloud_.camera_in_base.inverse() * position); }

  StereoCloud& cloud() {
    cloud_.points.data = reinterpret_cast<const std::uint8_t*>(memory_.data());
    cloud_.points.step = kFloats * sizeof(float);
    cloud_.points.count = memory_.size() / kFloats;
    return cloud_;
  }

  EIGEN_MAKE_ALIGNED_OPERATOR_NEW

 private:
  static constexpr std::size_t kFloats = 4;  ///< x, y, z, and padding
  static constexpr int kHalfWidth = 200;     ///< px
  static constexpr int kHalfHeight = 120;    ///< px

  void mount(double height, double yaw, double pitch) {
    Eigen::Matrix3d axes;  // right, down, ahead
    axes << 0.0, 0.0, 1.0, -1.0, 0.0, 0.0, 0.0, -1.0, 0.0;
    cloud_.camera_in_base.linear() = Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()) *
                                     Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitY()) * axes;
    cloud_.camera_in_base.translation() = Eigen::Vector3d(0.5, 0.0, height);
  }

  /// What the camera takes a depth (m) for.
  double measured(double depth, const MadeScene& scene, Random& random) const {
    if (scene.depth_noise) {
      const double sigma = scene.depth_noise->sigma(depth);
      return depth + sigma * scene.depth_bias + random.normal(sigma);
    }
    const double disparity = cloud_.camera.focal_length * cloud_.camera.baseline / depth;
    const double noisy = disparity + scene.disparity_bias + random.normal(scene.disparity_noise);
    return depth * disparity / noisy;
  }

  /// Returns the distance to the nearest thing on a line of sight, in lengths of `end` - `origin`.
  static double depthAlong(const Eigen::Vector3d& end, const Eigen::Vector3d& origin,
                           const MadeScene& scene) {
    const Eigen::Vector3d direction = end - origin;
    double nearest =
        direction.z() < 0.0 ? -origin.z() / direction.z() : std::numeric_limits<double>::infinity();
    const double ahead = origin.x() + nearest * direction.x();
    if (scene.hole && ahead > scene.hole->begin && ahead < scene.hole->end) {
      nearest = std::numeric_limits<double>::infinity();
    }
    for (const MadeBox& box : scene.boxes) {
      const Eigen::Array3d one = (box.min - origin).array() / direction.array();
      const Eigen::Array3d other = (box.max - origin).array() / direction.array();
      const double enter = one.min(other).maxCoeff();
      const double leave = one.max(other).minCoeff();
      if (enter > 0.0 && enter < leave) {
        nearest = std::min(nearest, enter);
      }
    }
    return std::isfinite(nearest) ? nearest : std::numeric_limits<double>::quiet_NaN();
  }

  StereoCloud cloud_;
  std::vector<float> memory_;
};

/// A wall across the view, `width` wide, centered on the x axis, 2 m high; m.
inline MadeBox wallAt(double distance, double width) {
  return {{distance, -0.5 * width, 0.0}, {distance + 0.5, 0.5 * width, 2.0}};
}

}  // namespace datmo
