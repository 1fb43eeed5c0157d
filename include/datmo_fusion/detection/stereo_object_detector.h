// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>

#include "datmo_fusion/common/object.h"
#include "datmo_fusion/common/options.h"
#include "datmo_fusion/detection/object_classifier.h"
#include "datmo_fusion/sensor_model/road_plane.h"
#include "datmo_fusion/sensor_model/road_scene.h"
#include "datmo_fusion/sensor_model/stereo_cloud.h"

namespace datmo {

/// Which points of a cloud form upright surfaces.
struct StereoSurfaceOptions {
  double min_depth = 0.5;     ///< m
  double min_height = 0.3;    ///< m
  double max_height = 5.0;    ///< m
  double finest_depth = 0.1;  ///< m
  int min_points = 3;

  void visit(OptionVisitor& visitor);
};

/// Which surfaces belong together.
struct SurfaceGroupOptions {
  /// m, 0.01 to 5: neighboring surfaces of one object differ in depth by less than this
  double depth_gap = 0.6;
  double depth_sigmas = 1.2;  ///< standard deviations of the depth
  double tall = 2.6;          ///< m
  double low = 2.0;           ///< m

  void visit(OptionVisitor& visitor);
};

/// Uncertainty of the visible part of an object.
struct StereoNoiseOptions {
  double common = 0.5;             ///< standard deviations of the depth
  double column = 0.5;             ///< standard deviations of the depth
  double correlated_width = 16.0;  ///< px
  double edge_sigma = 1.0;         ///< px
  double body_sigma = 0.2;         ///< m
  double height_sigma = 0.1;       ///< m

  void visit(OptionVisitor& visitor);
};

struct StereoObjectDetectorOptions : RoadSceneOptions {
  StereoSurfaceOptions surfaces;
  SurfaceGroupOptions groups;
  StereoNoiseOptions noise;
  ObjectClassifierOptions classes;
  double sure_range = 25.0;  ///< m
  /// m^2, 0 to 10: an object with less visible surface is rejected
  double min_surface = 0.15;
  double max_size = 12.0;  ///< m
  double max_doubt = 3.0;  ///< log odds

  void visit(OptionVisitor& visitor);
};

/// The result for one cloud.
struct StereoObjects {
  ObjectList list;         ///< vehicle's frame, with the camera's field of view
  RoadPlane road;          ///< reference of heights
  bool road_seen = false;  ///< false: the last known one
  std::size_t points = 0;  ///< finite and in front of the camera
};

/// Detects the road users and poles in one cloud of a stereo camera, as classified cuboids (thesis
/// 3.3.2).
///
/// The road plane is estimated, and what stands on it is processed in columns of the camera's level
/// image: the surfaces in each column, which may be behind each other, are grouped over columns;
/// each group is fitted with a box (fitBox) and classified by its size (ObjectClassifier). Objects
/// larger than road users, or more probably something else, are left out.
///
/// The depth noise that an object's points have in common is in its position covariance, the rest
/// in that of its sides. Sides that were not seen are kHiddenSide: those that face away, those next
/// to something nearer, and those at the end of the image, or of what both cameras see.
///
/// Log odds are at most 0: looking less like a road user than the average object counts against an
/// object, but looking like one is no proof. `points` are the near outline, left to right. Objects
/// are sorted from left to right by where they begin, with dynamic state kUnknown.
///
/// A cloud may be dense or thinned, organized or not: its density is estimated. Not thread-safe.
/// Keeps the last road plane from cloud to cloud.
class StereoObjectDetector {
 public:
  /// Throws OptionError.
  explicit StereoObjectDetector(const Checked<StereoObjectDetectorOptions>& options);
  ~StereoObjectDetector();

  /// Throws std::invalid_argument for invalid cameras, see StereoView.
  StereoObjects detect(const StereoCloud& cloud);

  /// Forgets the last road plane, as after construction.
  void reset();

 private:
  class State;
  std::unique_ptr<State> state_;
};

}  // namespace datmo
