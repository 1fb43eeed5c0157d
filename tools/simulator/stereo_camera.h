// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "simulator/disparity_image.h"
#include "simulator/random_stream.h"
#include "simulator/sloped_ray.h"
#include "simulator/surface_texture.h"
#include "simulator/viewpoint.h"
#include "simulator/world.h"
#include <Eigen/Core>

#include "datmo_fusion/common/options.h"

namespace datmo::simulator {

/// The demonstrator's stereo camera (thesis 1.3.3 and 3.2.2), its matching, and their faults.
struct StereoCameraOptions {
  bool enabled = false;
  double mount_x = 1.8;              ///< m
  double mount_y = 0.17;             ///< m
  double mount_height = 1.3;         ///< m
  double mount_heading_error = 0.0;  ///< deg
  double stamp_error = 0.0;          ///< s
  double baseline = 0.34;            ///< m

  double rate = 12.0;             ///< Hz
  double latency = 0.05;          ///< s
  int image_width = 512;          ///< px
  int image_height = 256;         ///< px
  double focal_length = 380.0;    ///< px
  int column_step = 1;            ///< px
  int row_step = 1;               ///< px
  double min_range = 3.0;         ///< m
  double max_range = 60.0;        ///< m
  double effective_range = 36.0;  ///< m

  double disparity_noise = 0.25;  ///< px
  double disparity_bias = 0.0;    ///< px
  double noise_common_share = 0.5;
  int noise_patch = 16;              ///< px
  double weak_texture_patch = 0.4;   ///< m
  double weak_texture_share = 0.15;  ///< 0 to 1
  double weak_road_share = 0.3;      ///< 0 to 1
  int edge_width = 2;                ///< px
  double edge_mixing = 0.5;          ///< 0 to 1
  double outlier_share = 0.01;       ///< 0 to 1
  int outlier_patch = 4;             ///< px
  double pitch_shake = 0.3;          ///< deg
  bool features = true;
  int feature_spacing = 5;            ///< px
  double feature_share = 0.1;         ///< 0 to 1
  double feature_noise = 0.12;        ///< px
  double wrong_feature_share = 0.05;  ///< 0 to 1

  void visit(OptionVisitor& visitor);

  /// Middle of the image, px: of both columns and rows.
  double middleColumn() const { return 0.5 * (image_width - 1); }
  double middleRow() const { return 0.5 * (image_height - 1); }
  /// Disparity (px) of a point at a depth (m), and vice versa.
  double disparityAt(double depth) const { return focal_length * baseline / depth; }
  double depthAt(double disparity) const { return focal_length * baseline / disparity; }
};

/// Points of one pair of images, in the left camera's optical frame (x right, y down, z forward).
struct StereoPoints {
  double time = 0.0;                    ///< s, of the pair
  std::vector<Eigen::Vector3f> points;  ///< m, row by row
};

/// Observes a world with two level cameras side by side, and returns the points found by matching
/// their images. Paint on the road is treated as road, a curb as a low solid.
class StereoCamera {
 public:
  /// `seed`: of the run. Throws OptionError for options that contradict each other.
  StereoCamera(const StereoCameraOptions& options, std::uint64_t seed);

  StereoPoints measure(const World& world, double time);

  /// Of the left camera, within the effective range.
  Viewpoint viewpoint() const;

 private:
  DisparityImage look(const World& world, const WorldState& state, double nod) const;
  void lookAlongColumn(const RayCaster& caster, const Pose2& camera, int column, double nod,
                       DisparityImage& image) const;
  std::vector<Eigen::Vector3f> pointsOf(const DisparityImage& image) const;

  StereoCameraOptions options_;
  RandomStream random_;
  SurfaceTexture texture_;
};

}  // namespace datmo::simulator
