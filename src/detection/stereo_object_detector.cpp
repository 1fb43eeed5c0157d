#include "datmo_fusion/detection/stereo_object_detector.h"

#include <algorithm>
#include <cmath>

#include "stereo_object_maker.h"
#include "stereo_surfaces.h"
#include "surface_groups.h"

#include "datmo_fusion/common/angle.h"
#include "datmo_fusion/sensor_model/stereo_view.h"

namespace datmo {

namespace {

constexpr char kSensor[] = "stereo";

/// Points up to so many standard deviations beyond the effective range still belong to it.
constexpr double kBeyondRange = 2.0;

/// Bearings to the left about the camera's x axis on the ground, of what lies to the right.
FieldOfView fieldOf(const StereoCamera& camera, const StereoView& view,
                    const StereoObjectDetectorOptions& options) {
  const Point2 ahead = view.positionOf({1.0, 0.0}) - view.position();
  FieldOfView field;
  field.sensor_in_base = Pose2(view.position(), std::atan2(ahead.y(), ahead.x()));
  field.least_bearing = -std::atan(camera.right_tangent);
  field.most_bearing = -std::atan(camera.left_tangent);
  field.sure_range = std::min(options.sure_range, options.effective_range);
  field.range = options.effective_range;
  return field;
}

}  // namespace

void StereoSurfaceOptions::visit(OptionVisitor& visitor) {
  visitor.number({"nearest_depth", "m", "nearer points are mismatches"}, nearest_depth,
                 {0.05, 10.0});
  visitor.number({"least_height", "m", "lower points are of the road, kerbs and low plants"},
                 least_height, {0.05, 2.0});
  visitor.number({"layer_top", "m",
                  "points between least_height and this make objects: higher, one sees over road "
                  "users at what is behind them"},
                 layer_top, {0.3, 5.0});
  visitor.number({"highest", "m", "up to here it is looked how high objects are"}, highest,
                 {2.0, 20.0});
  visitor.number({"road_sigmas", "1",
                  "a point is one of the road if a depth that is wrong by so many standard "
                  "deviations puts it where it is"},
                 road_sigmas, {0.0, 10.0});
  visitor.number({"finest_depth", "m", "depths are not told apart finer than this"}, finest_depth,
                 {0.02, 1.0});
  visitor.number({"least_visible", "m", "height of surface that must be seen in a column"},
                 least_visible, {0.0, 2.0});
  visitor.integer({"least_points", "1", "and points"}, least_points, {1, 1000});
}

void SurfaceGroupOptions::visit(OptionVisitor& visitor) {
  visitor.number({"lateral_gap", "m", "surfaces farther apart sideways are not of one object"},
                 lateral_gap, {0.0, 5.0});
  visitor.number({"depth_gap", "m", "neighbouring surfaces of one object differ in depth by less"},
                 depth_gap, {0.01, 5.0});
  visitor.number({"depth_sigmas", "1", "or by so many standard deviations of the depth"},
                 depth_sigmas, {0.0, 10.0});
  visitor.number(
      {"tall", "m", "what is higher than this does not belong to what is lower than low"}, tall,
      {0.5, 20.0});
  visitor.number({"low", "m", "see tall"}, low, {0.3, 20.0});
}

void StereoObjectDetectorOptions::visit(OptionVisitor& visitor) {
  visitor.group("surfaces", [&] { surfaces.visit(visitor); });
  visitor.group("groups", [&] { groups.visit(visitor); });
  visitor.group("road", [&] { road.visit(visitor); });
  visitor.group("classes", [&] { classes.visit(visitor); });
  visitor.number({"effective_range", "m", "nothing is said beyond it (thesis 3.3.3: 36 m)"},
                 effective_range, {1.0, 200.0});
  visitor.number(
      {"sure_range", "m", "up to here all is found that can be seen; from there on less and less"},
      sure_range, {1.0, 200.0});
  visitor.number({"least_surface", "m^2", "an object of which less is seen is none"}, least_surface,
                 {0.0, 10.0});
  visitor.number({"largest_size", "m", "longer things are no objects: walls, hedges"}, largest_size,
                 {0.5, 100.0});
  visitor.number({"common_noise", "1",
                  "standard deviation of an object's depth, in those of a single point: noise that "
                  "its points have in common"},
                 common_noise, {0.0, 5.0});
  visitor.number(
      {"surface_noise", "1", "the same of the depth of one column of an object against the others"},
      surface_noise, {0.0, 5.0});
  visitor.number({"edge_sigma", "px", "standard deviation of where a surface ends in the image"},
                 edge_sigma, {0.0, 20.0});
  visitor.number({"position_sigma", "m",
                  "standard deviation of what bodies are off from boxes along each axis"},
                 position_sigma, {0.001, 2.0});
}

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
    const double farthest =
        std::min(2.0 * options_.effective_range,
                 options_.effective_range +
                     kBeyondRange * cloud.camera.depthSigma(options_.effective_range));
    surfaces_.find(cloud, view, options_.surfaces, farthest);
    result.points = surfaces_.points();
    const StereoObjectMaker maker(options_, classifier_, cloud.camera, view, surfaces_);
    for (const SurfaceGroup& group :
         groupSurfaces(surfaces_.columns(), cloud.camera, options_.groups)) {
      if (std::optional<Object> object = maker.make(group)) {
        result.list.objects.push_back(std::move(*object));
      }
    }
    result.list.views.push_back({kSensor, fieldOf(cloud.camera, view, options_)});
    return result;
  }

  void reset() { road_.reset(); }

 private:
  StereoObjectDetectorOptions options_;
  RoadPlaneEstimator road_;
  ObjectClassifier classifier_;
  StereoSurfaces surfaces_;  ///< memory that is used again
};

StereoObjectDetector::StereoObjectDetector(const StereoObjectDetectorOptions& options) {
  checkOptions(options);
  state_ = std::make_unique<State>(options);
}

StereoObjectDetector::~StereoObjectDetector() = default;

StereoObjects StereoObjectDetector::detect(const StereoCloud& cloud) {
  return state_->detect(cloud);
}

void StereoObjectDetector::reset() { state_->reset(); }

}  // namespace datmo
