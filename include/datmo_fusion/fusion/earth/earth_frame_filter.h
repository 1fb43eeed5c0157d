// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/common/pose2.h"
#include "datmo_fusion/common/stamp.h"

namespace datmo {

struct EarthFrameOptions {
  double correlated_share = 0.8;   ///< 1
  double correlation_time = 60.0;  ///< s
  double map_drift = 0.05;         ///< m / sqrt(m)
  double map_turn = 0.002;         ///< rad / sqrt(m)
  double gate = 13.8;              ///< 1
  int restart_after = 10;
  /// rad, 0.001 to 0.5: standard deviation of the map's heading below which it counts as known
  double start_heading_sigma = 0.1;
  /// m, 0.01 to 1000: RMS distance of the first fixes from their mean; below it, jittering poses
  /// could pass for a drive
  double start_spread = 2.0;
  /// 3 to 400: minimum number of first fixes that are consistent: with fewer, an outlier bends the
  /// rest to itself
  int start_fixes = 6;
  double start_share = 0.7;  ///< 1
  double max_gap = 10.0;     ///< s

  void visit(OptionVisitor& visitor);
};

/// One position fix of the receiver, and the vehicle's pose in the map at the same time.
struct EarthFix {
  Stamp stamp;
  Point2 in_plane = Point2::Zero();                          ///< m, east and north
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Identity();  ///< m^2, positive definite
  PoseWithCovariance base_in_map;                            ///< at the same time
  Point2 antenna_in_base = Point2::Zero();                   ///< m
};

struct EarthFrameCounts {
  std::uint64_t used = 0;
  std::uint64_t gated = 0;     ///< too far from the vehicle's expected position
  std::uint64_t restarts = 0;  ///< after gated fixes in a row or a gap, or if not finite
};

/// Estimates where the map lies on the earth: position and heading of the map's frame in a local
/// plane (x east, y north), from positions of a satellite receiver and the poses in the map at the
/// same times.
///
/// It starts with weighted least squares over all fixes that fit together (Arun, Huang, Blostein
/// 1987, in the plane; consistentPairs), until the vehicle has driven far enough for the heading to
/// be observable, and continues with an extended Kalman filter. Its state includes the receiver's
/// error that successive fixes share (atmosphere, multipath), as a Gauss-Markov process: without it
/// the covariance would shrink with each fix as if they were independent. The map drifts with the
/// distance driven, turning about the vehicle.
class EarthFrameFilter {
 public:
  /// Throws OptionError.
  explicit EarthFrameFilter(const Checked<EarthFrameOptions>& options) : options_(*options) {}

  /// Processes the next fix. Stamps must rise.
  void add(const EarthFix& fix);

  /// Reports the vehicle's pose after the last fix: the map drifts with the distance driven from
  /// pose to pose. Without it, the drive between two fixes counts as a straight line.
  void moveTo(const Pose2& base_in_map);

  /// Pose of the map's frame in the plane at the last pose; none until the heading is known.
  std::optional<PoseWithCovariance> mapInPlane() const;

  /// The same at this pose of the vehicle, assuming a straight drive from the last one.
  std::optional<PoseWithCovariance> mapInPlane(const Pose2& base_in_map) const;

  const EarthFrameCounts& counts() const { return counts_; }

  /// Forgets everything except the counts.
  void reset();

 private:
  static constexpr int kState = 5;  ///< x, y, heading of the map, shared error east, north
  using State = Eigen::Matrix<double, kState, 1>;
  using Covariance = Eigen::Matrix<double, kState, kState>;

  void incorporate(const EarthFix& fix);
  /// Result of least squares over the first fixes.
  struct Start {
    double count = 0.0;    ///< number of fixes
    double weights = 0.0;  ///< sum, 1 / m^2
    double drift = 0.0;    ///< drift variance of the map meanwhile, m^2
    Point2 mean_in_plane = Point2::Zero();
    Point2 mean_in_map = Point2::Zero();  ///< antenna position
    double heading = 0.0;                 ///< rad
    double heading_variance = 0.0;        ///< rad^2
  };

  double changedShare(const std::vector<EarthFix>& fixes) const;
  double driftAmong(const std::vector<EarthFix>& fixes, double lever) const;
  /// None while there are too few fixes, or they do not determine the heading.
  std::optional<Start> startOf(const std::vector<EarthFix>& fixes) const;
  void start();
  void begin(const Start& start, double factor);
  Eigen::Matrix3d driftedTo(const Pose2& base_in_map) const;
  void drift(const Pose2& base_in_map);
  void restartIfInvalid();
  void predict(const EarthFix& fix);
  bool update(const EarthFix& fix);

  EarthFrameOptions options_;
  EarthFrameCounts counts_;
  std::vector<EarthFix> first_fixes_;
  bool has_started_ = false;
  State state_ = State::Zero();
  Covariance covariance_ = Covariance::Zero();
  Stamp last_stamp_;  ///< of the last fix
  Pose2 driven_to_;   ///< pose up to which the map's drift is in the covariance
  int gated_in_a_row_ = 0;
};

}  // namespace datmo
