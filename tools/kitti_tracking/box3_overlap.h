// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace datmo::kitti {

/// An upright box as in KITTI (Geiger et al., 2012): in the frame of the rectified camera, x right,
/// y down, z forward, m.
struct Box3 {
  double x = 0.0;  ///< m, center of the lower face
  double y = 0.0;
  double z = 0.0;
  double length = 0.0;      ///< m, along x at rotation_y 0
  double width = 0.0;       ///< m, along z at rotation_y 0
  double height = 0.0;      ///< m, from y upwards
  double rotation_y = 0.0;  ///< rad, about y: a box at pi / 2 points backward, to -z
};

/// Area of the intersection of both boxes on the ground, m^2. Sizes must not be negative.
double groundIntersection(const Box3& a, const Box3& b);

/// Volume of the intersection over the volume of the union, 0 to 1; 0 if neither has a volume.
/// Sizes must not be negative.
double overlap3d(const Box3& a, const Box3& b);

}  // namespace datmo::kitti
