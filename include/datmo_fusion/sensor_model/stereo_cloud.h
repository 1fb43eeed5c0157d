// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "datmo_fusion/common/stamp.h"
#include "datmo_fusion/sensor_model/depth_noise.h"

namespace datmo {

/// Points of a stereo or depth camera in their memory layout (a PointCloud2's data): three floats
/// each, in the camera's optical frame: x to the right, y down, z forward, m. Points that are not
/// finite are holes. Does not own the memory.
struct PointsView {
  const std::uint8_t* data = nullptr;
  std::size_t count = 0;
  std::size_t step = 0;      ///< bytes from one point to the next
  std::size_t x_offset = 0;  ///< bytes from a point's start
  std::size_t y_offset = 4;
  std::size_t z_offset = 8;
  /// 1/m, added to the inverse of each z when a point is read, along its line of sight: corrects a
  /// disparity bias without a copy of the cloud.
  float inverse_shift = 0.0F;

  Eigen::Vector3f operator[](std::size_t index) const {
    const Eigen::Vector3f point = stored(index);
    return inverse_shift == 0.0F ? point : Eigen::Vector3f(point / shrinkage(point.z()));
  }

  /// Returns a point without the shift.
  Eigen::Vector3f stored(std::size_t index) const {
    const std::uint8_t* point = data + index * step;
    Eigen::Vector3f result;
    std::memcpy(&result.x(), point + x_offset, sizeof(float));
    std::memcpy(&result.y(), point + y_offset, sizeof(float));
    std::memcpy(&result.z(), point + z_offset, sizeof(float));
    return result;
  }

  /// Returns by what the shift divides a stored point at this z (m); NaN for one that it leaves
  /// without a depth.
  float shrinkage(float z) const {
    const float factor = 1.0F + inverse_shift * z;
    return factor > 0.0F ? factor : std::numeric_limits<float>::quiet_NaN();
  }
};

/// A camera that measures depth: a pair of cameras, or a depth camera (structured light, time of
/// flight).
struct StereoCamera {
  double focal_length = 0.0;  ///< px, more than 0
  /// m, to the right: position of the other device that sees or lights the scene, the right camera
  /// or the projector. Points hidden from it have no depth. 0: there is none (time of flight).
  double baseline = 0.0;
  DepthNoise noise;  ///< more than 0 at all depths
  /// Left and right borders of the image as tangents x / z of the optical frame.
  double left_tangent = 0.0;
  double right_tangent = 0.0;
  /// px^2; variance of a bias that all disparities have in common.
  double disparity_offset_variance = 0.0;

  /// Returns the standard deviation of a depth, m.
  double depthSigma(double depth) const { return noise.sigma(depth); }

  /// Returns the standard deviation of the error that all depths have in common, m.
  double commonDepthSigma(double depth) const {
    return depth * depth * std::sqrt(disparity_offset_variance) / noise.disparity_at_meter;
  }
};

/// One measurement of a stereo or depth camera.
struct StereoCloud {
  Stamp stamp;
  PointsView points;
  StereoCamera camera;
  Eigen::Isometry3d camera_in_base = Eigen::Isometry3d::Identity();  ///< the optical frame
  /// Height of the planar scanner above base_link's origin, m: the bottom of the layer that it
  /// sees.
  double scanner_height = 0.0;

  EIGEN_MAKE_ALIGNED_OPERATOR_NEW
};

}  // namespace datmo
