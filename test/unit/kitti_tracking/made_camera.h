// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "kitti_tracking/camera_mount.h"

namespace datmo::kitti {

/// A forward-looking camera 1 m ahead of the vehicle's origin and 0.3 m to its right: 700 px focal
/// length, center at 600, 180.
inline Calibration madeCalibration() {
  Calibration calibration;
  calibration.image_from_camera << 700, 0, 600, 0, 0, 700, 180, 0, 0, 0, 1, 0;
  calibration.rectification.setIdentity();
  // The velodyne's frame is that of the vehicle.
  calibration.velodyne_from_imu.setIdentity();
  calibration.camera_from_velodyne << 0, -1, 0, -0.3, 0, 0, -1, 0, 1, 0, 0, -1;
  return calibration;
}

inline CameraMount madeCamera() { return {madeCalibration(), {1200.0, 360.0}}; }

/// A box of 4 x 2 x 1.5 m, 1.6 m below the camera.
inline Box3 boxAt(double right, double ahead, double rotation_y = 0.0) {
  Box3 box;
  box.x = right;
  box.y = 1.6;
  box.z = ahead;
  box.length = 4.0;
  box.width = 2.0;
  box.height = 1.5;
  box.rotation_y = rotation_y;
  return box;
}

}  // namespace datmo::kitti
