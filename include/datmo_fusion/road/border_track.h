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

/// A point that was seen on a border.
struct BorderHit {
  CurvePoint position;    ///< beside the line
  double variance = 0.0;  ///< m^2 across the line: of the measurement and of the border's shape
};

/// The line of one stretch of border in the map, estimated by a Kalman filter: errors of its offset
/// to the left (m), heading (rad), curvature (1/m) and curvature rate (1/m^2) at its anchor, which
/// goes along with the vehicle. The line is fixed to the map: the vehicle's motion moves nothing
/// but the anchor, along the line, and so no error comes from it; what roads and maps do that no
/// clothoid does is noise for each meter that the anchor goes, and each second.
class BorderTrack {
 public:
  /// From a straight piece: covariance over its offset and heading at its anchor.
  BorderTrack(const BorderTrackOptions& options, const Pose2& line,
              const Eigen::Matrix2d& covariance);

  const BorderCurve& curve() const { return curve_; }

  /// Over offset, heading, curvature and curvature rate at the anchor.
  const Eigen::Matrix4d& covariance() const { return covariance_; }

  /// Way of the anchor along the line since the track began, m.
  double arcLength() const { return arc_length_; }

  /// Variance of the line across itself, m^2, `along` (m) from the anchor.
  double varianceAt(double along) const;

  /// Takes the anchor so far along the line (m, negative: back), `seconds` (0 or more) on.
  void advance(double along, double seconds);

  /// Takes points in, those beyond the gate left out; how many were taken. `novelty`: 0 to 1, how
  /// much of them is new information (ScanNovelty).
  int correct(const std::vector<BorderHit>& hits, double novelty = 1.0);

 private:
  /// Variance by which the road deviates within a distance from the anchor, m^2.
  double wander(double along) const;

  BorderTrackOptions options_;
  BorderCurve curve_;
  Eigen::Matrix4d covariance_ = Eigen::Matrix4d::Zero();
  double arc_length_ = 0.0;
};

}  // namespace datmo
