// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/common/scan.h"
#include "datmo_fusion/common/twist2.h"
#include "datmo_fusion/sensor_model/stereo_alignment.h"
#include "datmo_fusion/sensor_model/stereo_cloud.h"
#include "datmo_fusion/sensor_model/stereo_view.h"

namespace datmo {

struct SurfacePairOptions {
  double min_height = 0.4;  ///< m
  double max_height = 1.0;  ///< m
  double max_range = 30.0;  ///< m
  double max_step = 0.5;    ///< m
  /// 1 to 100: neighboring beams of one surface may also be this many times their spacing apart: 2,
  /// on a surface that is slanted by 60 degrees
  double max_step_ratio = 2.0;
  double max_length = 2.0;      ///< m, 0.1 to 20: length of a surface; longer ones are divided
  int min_beams = 3;            ///< 1
  double min_incidence = 0.5;   ///< 1
  double straightness = 0.05;   ///< m
  double range_sigma = 0.03;    ///< m
  double edge_pixels = 3.0;     ///< px
  int min_points = 20;          ///< 1
  double min_share = 0.6;       ///< 1
  double mode_width = 1.0;      ///< px
  double max_difference = 8.0;  ///< px

  void visit(OptionVisitor& visitor);
};

/// Finds surfaces that both a scanner and a stereo camera see frontally: straight pieces of the
/// scan, and for each the disparities of the cloud in its columns, between two heights. If most of
/// these do not agree with each other, there are two surfaces, and no pair.
class SurfacePairFinder {
 public:
  /// Throws OptionError.
  explicit SurfacePairFinder(const Checked<SurfacePairOptions>& options);

  /// Returns the pairs. `rays`: by ascending beam index, in the vehicle's frame at the cloud's
  /// stamp. `expected`: current alignment of cloud and scan, which determines where disparities are
  /// searched. Throws std::invalid_argument for invalid cameras, see StereoView.
  std::vector<SurfacePair> find(const StereoCloud& cloud, const std::vector<Ray>& rays,
                                const StereoAlignment& expected, const Twist2& twist);

 private:
  /// A point of the cloud or of the scan in the camera's top view.
  struct InView {
    double tangent = 0.0;  ///< to the right of the camera's heading
    double inverse = 0.0;  ///< 1/m
  };
  /// Connected points of the scan.
  using Piece = std::vector<InView>;

  void addPoints(const StereoCloud& cloud, const StereoView& view);
  /// Whether a beam's end continues a piece that began at `begin`.
  bool goesOn(const Ray& last, const Ray& ray, const Point2& begin) const;
  std::vector<Piece> piecesOf(const std::vector<Ray>& rays, const StereoView& view) const;
  /// Adds the pair of a piece, if there is one.
  void add(const Piece& piece, const StereoCamera& camera, const StereoAlignment& expected,
           const Twist2& twist, std::vector<SurfacePair>& pairs);
  /// Fits the plane of a piece; false if it is not planar or not frontal. `variance`: px^2.
  bool fit(const Piece& piece, double disparity_at_meter, SurfacePair& pair) const;
  /// False if the cloud's points between two tangents are not on one surface.
  bool compare(double left, double right, double disparity_at_meter, double predicted,
               SurfacePair& pair);

  SurfacePairOptions options_;
  double left_ = 0.0;                         ///< tangent of the image's border
  double per_tangent_ = 0.0;                  ///< columns
  std::vector<std::vector<InView>> columns_;  ///< of the cloud; reused memory
  std::vector<double> differences_;           ///< px; reused memory
};

}  // namespace datmo
