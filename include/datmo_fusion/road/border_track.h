// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Core>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/road/border_curve.h"

namespace datmo {

struct BorderTrackOptions {
  double offset_drift = 0.03;            ///< m per square root of m
  double heading_drift = 0.003;          ///< rad per square root of m
  double curvature_drift = 0.0003;       ///< 1/m per square root of m
  double curvature_sigma = 0.002;        ///< 1/m
  double curvature_rate_sigma = 0.0001;  ///< 1/m^2
  double curvature_rate_length = 20.0;   ///< m
  double map_drift = 0.01;               ///< m per square root of s
  double gate = 3.0;                     ///< 1

  void visit(OptionVisitor& visitor);
};

/// A point measured on a border.
struct BorderHit {
  CurvePoint position;    ///< relative to the line
  double variance = 0.0;  ///< m^2 across the line: of the measurement and of the border's roughness
};

/// Kalman filter for one section of border in the map: errors of its offset to the left (m),
/// heading (rad), curvature (1/m) and curvature rate (1/m^2) at its anchor, which moves along with
/// the vehicle. The line is fixed in the map: the vehicle's motion only moves the anchor along it,
/// which adds no error. Deviations of the road and the map from a clothoid are process noise per
/// meter of anchor travel and per second.
class BorderTrack {
 public:
  /// Starts from a straight piece, with the covariance of its offset and heading at its anchor.
  BorderTrack(const BorderTrackOptions& options, const Pose2& line,
              const Eigen::Matrix2d& covariance);

  const BorderCurve& curve() const { return curve_; }

  /// Of offset, heading, curvature and curvature rate at the anchor.
  const Eigen::Matrix4d& covariance() const { return covariance_; }

  /// Distance that the anchor has moved along the line since the track began, m.
  double arcLength() const { return arc_length_; }

  /// Lateral variance of the line, m^2, at `along` (m) from the anchor.
  double varianceAt(double along) const;

  /// Moves the anchor along the line by `along` (m, negative: back) and predicts by `seconds` (>=
  /// 0).
  void advance(double along, double seconds);

  /// Updates with the points inside the gate and returns their number. `novelty`: 0 to 1, their
  /// share of new information (ScanNovelty).
  int correct(const std::vector<BorderHit>& hits, double novelty = 1.0);

 private:
  /// Variance of the road's deviation from the line at a distance from the anchor, m^2.
  double wander(double along) const;

  BorderTrackOptions options_;
  BorderCurve curve_;
  Eigen::Matrix4d covariance_ = Eigen::Matrix4d::Zero();
  double arc_length_ = 0.0;
};

}  // namespace datmo
