// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <optional>

#include <Eigen/Core>

#include "datmo_fusion/common/pose2.h"
#include "datmo_fusion/common/stamp.h"

namespace datmo {

/// A matched scan, as far as it affects the drift of the map.
struct MatchedScan {
  Stamp stamp;
  PoseWithCovariance base_in_map;  ///< as matched: the covariance is relative to the current map
  double surface_age = 0.0;        ///< s, mean age of the surfaces that it was matched with
  double view_range = 0.0;         ///< m, mean range of its hits, the lever arm of a turn
};

/// Prior of odometry's scale.
struct ScalePrior {
  double variance = 0.0;    ///< of the speed, relative
  bool calibrated = false;  ///< whether it is estimated online from matches
};

/// Estimates how far the map itself has drifted since the start, which matching cannot observe.
///
/// What comes into view is written at a pose with an error, and later scans are matched with it. If
/// the matched surfaces are n scans old, the map takes over 1 / n of each match's error: an
/// independent error for each renewal of what is seen, a random walk over distance. At rest nothing
/// new comes into view, and nothing drifts.
///
/// What counts is the mean age, not the mean rate: if a share p(a) of what is matched has age a,
/// the map's error is d(t) = sum p(a) d(t - a) + m(t), and by the renewal theorem (Feller 1971,
/// XI.1) a match's error m stays in it for good with the weight 1 / sum a p(a). Quickly renewed
/// surfaces only make d wander about what the old ones hold: a share that never ages (a prior map)
/// bounds it. The mean of 1 / a would count this as drift.
///
/// In the direction of travel, odometry lays out the map: its scale (PoseFilter) is known only as
/// well as one renewal of the map shows it, by two matches over the distance in between. This error
/// is constant, so its effect grows with distance, not with the square root of it.
///
/// Surfaces that were written long ago, such as those of a prior map or of a revisited place, hold
/// the pose, and the map hardly drifts; odometry has laid out none of them.
///
/// Called by GridSlam. Used only for what is published.
class MapDrift {
 public:
  /// Order of the states: the map's pose, and odometry's scale.
  enum State { kX, kY, kHeading, kScale, kStates };
  using Covariance = Eigen::Matrix<double, kStates, kStates>;

  /// `scale`: of the odometry; `step`: distance, m, after which the errors of matches are
  /// independent: a cell of the map.
  MapDrift(const ScalePrior& scale, double step);

  /// The vehicle has moved in the map. `by_odometry`: odometry measured the distance.
  void moveTo(const Pose2& base_in_map, bool by_odometry);

  /// A scan that was not matched is written to the map at the pose of moveTo(), with the covariance
  /// of the prediction. The next match is with these surfaces, and does not observe their error.
  void writeUnmatched(const Eigen::Matrix3d& covariance) { unmatched_ = covariance; }

  /// A scan is written to the map at the pose of moveTo().
  void write(const MatchedScan& scan);

  /// Returns the covariance of the map about the vehicle, along the map's axes: x (m), y (m),
  /// heading (rad).
  Eigen::Matrix3d covariance() const { return covariance_.topLeftCorner<3, 3>(); }

  const Covariance& estimate() const { return covariance_; }
  /// Continues from the estimate of an earlier drift, of the same map, with the vehicle at this
  /// pose.
  void continueFrom(const Covariance& estimate, const Pose2& base_in_map) {
    covariance_ = estimate;
    pose_ = base_in_map;
  }

  /// Returns the standard deviation of odometry's scale.
  double scaleSigma() const;

 private:
  struct Written {
    Stamp stamp;
    double distance = 0.0;  ///< m, driven since the start
  };

  /// The motion since surfaces of this age (s) were written.
  struct Renewal {
    double scans = 1.0;       ///< 1 or more
    double distance = 0.0;    ///< m, as far as remembered
    double remembered = 1.0;  ///< 0 to 1, share of the age that is remembered
  };
  Renewal renewalOf(double age) const;

  /// How far the view has moved between two poses, m.
  static double moved(const Pose2& from, const Pose2& to, double view_range);
  void learnScale(double variance);

  bool learns_scale_;
  double step_;
  Covariance covariance_;
  std::optional<Pose2> pose_;
  std::optional<Pose2> since_;  ///< start of the motion that is not added to the drift yet
  double scans_since_ = 0.0;
  double laid_out_ = 1.0;  ///< share of what is seen that was mapped on this drive
  std::optional<Eigen::Matrix3d> unmatched_;  ///< of the last unmatched scan, until the next match
  std::deque<Written> written_;
};

}  // namespace datmo
