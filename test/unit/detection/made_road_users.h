// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "made_stereo.h"

#include "datmo_fusion/common/angle.h"
#include "datmo_fusion/detection/stereo_object_detector.h"

/// Input of a camera's object detector, and its output.
namespace datmo {

/// m from base_link's origin to the camera.
inline constexpr double kCameraX = 0.5;

/// Rear at a distance ahead, middle to the left; m.
inline MadeBox boxAt(double distance, double left, const Eigen::Vector3d& size) {
  return {{distance, left - 0.5 * size.y(), 0.0},
          {distance + size.x(), left + 0.5 * size.y(), size.z()}};
}
inline MadeBox carAt(double distance, double left) {
  return boxAt(distance, left, {4.2, 1.8, 1.5});
}
inline MadeBox pedestrianAt(double distance, double left) {
  return boxAt(distance, left, {0.5, 0.5, 1.75});
}

inline MadeScene sceneOf(const std::vector<MadeBox>& boxes) {
  MadeScene scene;
  scene.boxes = boxes;
  return scene;
}

inline StereoObjects detect(
    MadeCloud& made, const StereoObjectDetectorOptions& options = StereoObjectDetectorOptions()) {
  return StereoObjectDetector(options).detect(made.cloud());
}

inline std::vector<Object> objectsIn(
    const MadeScene& scene,
    const StereoObjectDetectorOptions& options = StereoObjectDetectorOptions()) {
  MadeCloud made(scene);
  return detect(made, options).list.objects;
}

/// Of scenes in which bodies are boxes.
inline StereoObjectDetectorOptions ofBoxes() {
  StereoObjectDetectorOptions options;
  options.noise.body_sigma = 0.05;
  return options;
}

/// Least x and least y of the corners of its box, m: its near end and its right end.
inline Point2 leastCorner(const Object& object) {
  Point2 least = object.box.center.position();
  for (const Point2& corner : object.box.corners()) {
    least = least.cwiseMin(corner);
  }
  return least;
}

inline const Object& nearest(const std::vector<Object>& objects) {
  return *std::min_element(objects.begin(), objects.end(), [](const Object& a, const Object& b) {
    return a.box.center.x() < b.box.center.x();
  });
}

struct Side {
  double position;  ///< m, along its normal
  double variance;  ///< m^2
};

/// The side of an object that faces a direction most.
inline Side sideToward(const Object& object, const Point2& direction) {
  const Pose2 turn(Point2::Zero(), object.box.center.heading());
  const std::array<Point2, kBoxSides> normals = {turn.rotate({1.0, 0.0}), turn.rotate({-1.0, 0.0}),
                                                 turn.rotate({0.0, 1.0}), turn.rotate({0.0, -1.0})};
  std::size_t best = 0;
  for (std::size_t i = 1; i < kBoxSides; ++i) {
    best = normals[i].dot(direction) > normals[best].dot(direction) ? i : best;
  }
  const double half = 0.5 * (best < 2 ? object.box.length : object.box.width);
  return {normals[best].dot(object.box.center.position()) + half, object.side_variance[best]};
}
inline Side rearOf(const Object& object) { return sideToward(object, {-1.0, 0.0}); }
inline Side leftOf(const Object& object) { return sideToward(object, {0.0, 1.0}); }
inline Side rightOf(const Object& object) { return sideToward(object, {0.0, -1.0}); }

}  // namespace datmo
