// SPDX-License-Identifier: BSD-3-Clause
#include "kitti_tracking/camera_mount.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

namespace datmo::kitti {

namespace {

/// Points closer to the camera's plane than this have no usable image position, m.
constexpr double kMinDepth = 0.1;

Eigen::Isometry3d isometry(const Projection& matrix) {
  Eigen::Isometry3d result = Eigen::Isometry3d::Identity();
  result.linear() = matrix.leftCols<3>();
  result.translation() = matrix.col(3);
  return result;
}

/// The camera looks along z, with x to the right: its frame on the ground looks along x.
Pose2 cameraInBase(const Calibration& calibration) {
  const Eigen::Isometry3d camera0_from_imu =
      isometry(calibration.camera_from_velodyne) * isometry(calibration.velodyne_from_imu);
  const Eigen::Vector3d position = camera0_from_imu.inverse().translation();
  const Eigen::Matrix3d imu_from_rectified =
      (calibration.rectification * camera0_from_imu.linear()).transpose();
  const Eigen::Vector3d ahead = imu_from_rectified.col(2);
  return {position.x(), position.y(), std::atan2(ahead.y(), ahead.x())};
}

/// Rotation about an axis that points down is to the right, and starts there.
double headingOf(double rotation_y) { return -rotation_y - 0.5 * kPi; }
double rotationOf(double heading) { return normalizeAngle(-heading - 0.5 * kPi); }

}  // namespace

CameraMount::CameraMount(const Calibration& calibration, const ImageSize& image)
    : image_from_camera_(calibration.image_from_camera),
      image_(image),
      camera_in_base_(kitti::cameraInBase(calibration)) {}

Box2 CameraMount::onGround(const Box3& box) const {
  return {camera_in_base_ * Pose2(box.z, -box.x, headingOf(box.rotation_y)), box.length, box.width};
}

Box3 CameraMount::standing(const Box2& box_in_base, double bottom, double height) const {
  const Pose2 center = camera_in_base_.inverse() * box_in_base.center;
  Box3 box;
  box.x = -center.y();
  box.y = bottom;
  box.z = center.x();
  box.length = box_in_base.length;
  box.width = box_in_base.width;
  box.height = height;
  box.rotation_y = rotationOf(center.heading());
  return box;
}

ImageBox CameraMount::inImage(const Box3& box) const {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  ImageBox around{kInfinity, kInfinity, -kInfinity, -kInfinity};
  const Box2 ground{Pose2(box.z, -box.x, headingOf(box.rotation_y)), box.length, box.width};
  for (const Point2& corner : ground.corners()) {
    for (const double y : {box.y, box.y - box.height}) {
      const double depth = std::max(kMinDepth, corner.x());
      const Eigen::Vector3d pixel =
          image_from_camera_ * Eigen::Vector4d(-corner.y(), y, depth, 1.0);
      const double column = std::clamp(pixel.x() / pixel.z(), 0.0, image_.width - 1.0);
      const double row = std::clamp(pixel.y() / pixel.z(), 0.0, image_.height - 1.0);
      around.left = std::min(around.left, column);
      around.right = std::max(around.right, column);
      around.top = std::min(around.top, row);
      around.bottom = std::max(around.bottom, row);
    }
  }
  return around;
}

double CameraMount::alpha(const Box3& box) {
  return normalizeAngle(box.rotation_y - std::atan2(box.x, box.z));
}

double CameraMount::bearingOf(double column) const {
  return std::atan((image_from_camera_(0, 2) - column) / image_from_camera_(0, 0));
}

double CameraMount::minBearing() const { return bearingOf(image_.width); }

double CameraMount::maxBearing() const { return bearingOf(0.0); }

}  // namespace datmo::kitti
