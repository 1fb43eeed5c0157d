#pragma once

#include <cstddef>
#include <memory>

#include "datmo_fusion/common/object.h"
#include "datmo_fusion/common/options.h"
#include "datmo_fusion/sensor_model/road_plane.h"
#include "datmo_fusion/sensor_model/stereo_cloud.h"

namespace datmo {

struct StereoObjectDetectorOptions {
  RoadPlaneOptions road;
  double effective_range = 36.0;  ///< m

  void visit(OptionVisitor& visitor);
};

/// What one cloud led to.
struct StereoObjects {
  ObjectList list;         ///< vehicle's frame, with the camera's field of view
  RoadPlane road;          ///< that heights were counted from
  bool road_seen = false;  ///< false: the last known one
  std::size_t points = 0;  ///< those that are finite and in front of the camera
};

/// One cloud of a stereo camera -> the road users and poles in it, classified cuboids (thesis
/// 3.3.2).
class StereoObjectDetector {
 public:
  /// Throws OptionError.
  explicit StereoObjectDetector(const StereoObjectDetectorOptions& options);
  ~StereoObjectDetector();

  /// Throws std::invalid_argument for a camera as StereoView does.
  StereoObjects detect(const StereoCloud& cloud);

  /// Forgets the last road plane, as after construction.
  void reset();

 private:
  class State;
  std::unique_ptr<State> state_;
};

}  // namespace datmo
