#include "datmo_fusion/detection/stereo_object_detector.h"

namespace datmo {

void StereoObjectDetectorOptions::visit(OptionVisitor& visitor) {
  visitor.group("road", [&] { road.visit(visitor); });
  visitor.number({"effective_range", "m", "nothing is said beyond it (thesis 3.3.3: 36 m)"},
                 effective_range, {1.0, 200.0});
}

class StereoObjectDetector::State {
 public:
  explicit State(const StereoObjectDetectorOptions& options)
      : options_(options), road_(options.road) {}

  StereoObjects detect(const StereoCloud& cloud) {
    StereoObjects result;
    result.list.stamp = cloud.stamp;
    const auto plane = road_.update(cloud);
    result.road = road_.last();
    result.road_seen = plane.has_value();
    return result;
  }

  void reset() { road_.reset(); }

 private:
  StereoObjectDetectorOptions options_;
  RoadPlaneEstimator road_;
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
