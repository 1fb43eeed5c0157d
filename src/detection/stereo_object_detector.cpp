// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/detection/stereo_object_detector.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "group_outline.h"
#include "stereo_object_maker.h"
#include "stereo_surfaces.h"
#include "surface_groups.h"

#include "datmo_fusion/sensor_model/stereo_view.h"

namespace datmo {

namespace {

/// Objects that are neither road user nor pole with more than this probability are left out.
constexpr double kMaxOther = 0.9;

/// The field of view on the ground, by bearings to the left of the camera's x axis.
FieldOfView fieldOf(const StereoCamera& camera, const StereoView& view,
                    const StereoObjectDetectorOptions& options) {
  const Point2 ahead = view.positionOf({1.0, 0.0}) - view.position();
  FieldOfView field;
  field.sensor_in_base = Pose2(view.position(), std::atan2(ahead.y(), ahead.x()));
  field.min_bearing = -std::atan(camera.right_tangent);
  field.max_bearing = -std::atan(camera.left_tangent);
  field.sure_range = std::min(options.sure_range, options.effective_range);
  field.range = options.effective_range;
  return field;
}

}  // namespace

class StereoObjectDetector::State {
 public:
  explicit State(const StereoObjectDetectorOptions& options)
      : options_(options), road_(options.road), classifier_(options.classes) {}

  StereoObjects detect(const StereoCloud& cloud) {
    StereoObjects result;
    result.list.stamp = cloud.stamp;
    result.road_seen = road_.update(cloud).has_value();
    result.road = road_.last();
    const StereoView view(cloud, result.road);
    surfaces_.find(cloud, view, options_.surfaces, options_.maxDepth(cloud.camera));
    result.points = surfaces_.points();
    const OutlineFinder finder(options_, cloud.camera, surfaces_);
    const StereoObjectMaker maker(options_, classifier_, cloud.camera, view, surfaces_);
    for (const SurfaceGroup& group :
         groupSurfaces(surfaces_.columns(), cloud.camera, options_.groups)) {
      const GroupOutline outline = finder.outlineOf(group);
      if (outline.surface < options_.min_surface || outline.length > options_.max_size ||
          outline.depth > options_.effective_range) {
        continue;
      }
      Object object = maker.objectOf(outline);
      if (probabilityOf(ObjectClass::kUnknown, object.class_probabilities) <= kMaxOther) {
        result.list.objects.push_back(std::move(object));
      }
    }
    result.list.views.push_back({kStereoSensor, fieldOf(cloud.camera, view, options_)});
    return result;
  }

  void reset() { road_.reset(); }

 private:
  StereoObjectDetectorOptions options_;
  RoadPlaneEstimator road_;
  ObjectClassifier classifier_;
  StereoSurfaces surfaces_;  ///< reused memory
};

StereoObjectDetector::StereoObjectDetector(const Checked<StereoObjectDetectorOptions>& options)
    : state_(std::make_unique<State>(*options)) {}

StereoObjectDetector::~StereoObjectDetector() = default;

StereoObjects StereoObjectDetector::detect(const StereoCloud& cloud) {
  return state_->detect(cloud);
}

void StereoObjectDetector::reset() { state_->reset(); }

}  // namespace datmo
