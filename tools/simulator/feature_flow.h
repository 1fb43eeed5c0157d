// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "simulator/random_stream.h"
#include "simulator/stereo_camera.h"
#include "simulator/surface_texture.h"
#include "simulator/world.h"
#include <Eigen/Geometry>

#include "datmo_fusion/common/stamp.h"
#include "datmo_fusion/vision/camera_motion.h"

namespace datmo::simulator {

/// Tracks corners through the images of a simulated stereo camera, with the errors of real matching
/// (noise, lost corners, wrong matches), and computes points with velocity as the real stage does,
/// with odometry as a prior of the camera's motion.
class FeatureFlow {
 public:
  /// `seed`: of the run.
  FeatureFlow(const StereoCameraOptions& options, std::uint64_t seed);

  /// Points with velocity over the ground at a time (s), in the vehicle's frame; none at the first
  /// exposure.
  std::vector<PointVelocity> measure(const World& world, double time);

 private:
  /// The camera at one exposure.
  struct View {
    double time = 0.0;
    double nod = 0.0;  ///< rad, upwards
    WorldState state;
  };

  std::vector<FeatureQuad> quads(const World& world, const View& before, const View& now);
  std::optional<FeatureQuad> quadAt(const Eigen::Vector2d& pixel, const RayCaster& caster,
                                    const View& before, const View& now);
  Eigen::Isometry3d cameraInWorld(const View& view) const;
  /// Returns none behind the camera, or outside its image.
  std::optional<StereoFeature> seen(const Eigen::Vector3d& point, const View& view) const;
  StereoFeature noisy(StereoFeature feature);
  CameraMotion prior(const View& before, const View& now) const;

  StereoCameraOptions options_;
  RandomStream random_;
  SurfaceTexture texture_;
  std::optional<View> last_;
};

}  // namespace datmo::simulator
