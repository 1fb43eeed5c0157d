// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "group_outline.h"
#include "stereo_surfaces.h"

#include "datmo_fusion/common/object.h"
#include "datmo_fusion/detection/object_classifier.h"
#include "datmo_fusion/detection/segment_end.h"
#include "datmo_fusion/detection/stereo_object_detector.h"
#include "datmo_fusion/sensor_model/stereo_view.h"

namespace datmo {

/// Sensor name of objects and views.
inline constexpr char kStereoSensor[] = "stereo";

/// Makes objects from groups of surfaces that a stereo camera sees.
class StereoObjectMaker {
 public:
  /// The arguments must outlive this object.
  StereoObjectMaker(const StereoObjectDetectorOptions& options, const ObjectClassifier& classifier,
                    const StereoCamera& camera, const StereoView& view,
                    const StereoSurfaces& surfaces);

  Object objectOf(const GroupOutline& outline) const;

 private:
  /// Where visible sides end along `normal`, the outward normal of the side at which they end:
  /// beyond the middle of the last column.
  std::optional<SurfaceEnd> endOn(const Point2& normal, const GroupOutline& outline) const;
  std::vector<Point2> pointsOf(const GroupOutline& outline) const;
  void setBox(Object& object, const GroupOutline& outline) const;
  SeenSize sizeOf(const GroupOutline& outline) const;
  Eigen::Matrix2d covarianceOf(const GroupOutline& outline) const;

  /// m, depth noise of one column of points relative to the others of the same object.
  double columnNoise(double depth) const {
    return options_.noise.column * camera_.depthSigma(depth);
  }
  /// Unit vector on the ground to the right of the camera's heading.
  Point2 toRight() const { return view_.positionOf({1.0, 1.0}) - view_.positionOf({1.0, 0.0}); }

  const StereoObjectDetectorOptions& options_;
  const ObjectClassifier& classifier_;
  const StereoCamera& camera_;
  const StereoView& view_;
  const SurfaceColumns& columns_;
  double max_tangent_;  ///< of the image, above the horizon
};

}  // namespace datmo
