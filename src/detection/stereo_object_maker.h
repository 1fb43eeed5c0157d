#pragma once

#include <array>
#include <optional>
#include <vector>

#include "stereo_surfaces.h"
#include "surface_groups.h"

#include "datmo_fusion/common/object.h"
#include "datmo_fusion/detection/object_classifier.h"
#include "datmo_fusion/detection/stereo_object_detector.h"

namespace datmo {

/// Makes objects of the surfaces in a cloud's columns that belong together.
class StereoObjectMaker {
 public:
  /// What is passed must outlive this.
  StereoObjectMaker(const StereoObjectDetectorOptions& options, const ObjectClassifier& classifier,
                    const StereoCamera& camera, const StereoView& view,
                    const StereoSurfaces& surfaces);

  /// Nothing of a group that is too small, too long or too high to be a road user or a pole.
  std::optional<Object> make(const SurfaceGroup& group) const;

 private:
  /// A group as the camera sees it; m.
  struct Outline {
    std::vector<ColumnSurface> columns;  ///< one for each column, left to right
    double depth = 0.0;                  ///< of its middle: median
    double top = 0.0;
    double surface = 0.0;  ///< m^2
    double across = 0.0;
  };

  /// Where a group ends to one side.
  struct End {
    bool seen = false;
    double beyond = 0.0;  ///< m, from the middle of the last column
    double sigma = 0.0;   ///< m
  };
  static constexpr std::size_t kLeftEnd = 0;
  static constexpr std::size_t kRightEnd = 1;
  using Ends = std::array<End, 2>;

  Outline outlineOf(const SurfaceGroup& group) const;
  bool isLeftOut(const Outline& outline) const;
  End endOf(const Outline& outline, std::size_t which) const;
  bool isHidden(const ColumnSurface& last, int step) const;
  std::vector<Point2> pointsOf(const Outline& outline) const;
  void setBox(Object& object, const Outline& outline, const Ends& ends) const;
  void setClass(Object& object, const Outline& outline, const Ends& ends) const;
  Eigen::Matrix2d covarianceOf(const Outline& outline) const;

  const StereoObjectDetectorOptions& options_;
  const ObjectClassifier& classifier_;
  const StereoCamera& camera_;
  const StereoView& view_;
  const StereoSurfaces& surfaces_;
  const SurfaceColumns& columns_;
  double highest_tangent_;  ///< of the image, above the horizon
};

}  // namespace datmo
