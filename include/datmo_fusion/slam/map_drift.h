// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <optional>

#include <Eigen/Core>

#include "datmo_fusion/common/pose2.h"
#include "datmo_fusion/common/stamp.h"

namespace datmo {

/// A scan that was matched, as far as the drift of the map depends on it.
struct MatchedScan {
  Stamp stamp;
  PoseWithCovariance base_in_map;  ///< as matched: the covariance is that in the map as it is
  double surface_age = 0.0;        ///< s, mean of the surfaces that it was matched with
  double view_range = 0.0;         ///< m, mean range of what it sees: so far a turn moves the view
};

/// What is known of odometry's scale at the start.
struct ScalePrior {
  double variance = 0.0;    ///< of its speed, as a share of it
  bool calibrated = false;  ///< whether it is estimated from matches, online
};

/// How far the map itself has drifted since the start, which a match in it cannot tell.
///
/// What comes into view is written at a pose that errs, and later scans are matched with it. Of
/// each match's error the map takes over one part in as many scans as the surfaces are old that it
/// was matched with: an error of its own in each renewal of what is seen, a random walk over
/// distance. At rest nothing comes into view, and nothing drifts.
///
/// The mean of ages is what counts, not that of rates: with the share p(a) of what is matched of
/// age a, the map's error is d(t) = sum p(a) d(t - a) + m(t), and by the renewal theorem (Feller
/// 1971, XI.1) a match's error m stays in it for good with the weight 1 / sum a p(a). That some
/// surfaces are renewed quickly makes d wander about what the old ones hold, no farther: a share
/// that never ages (a prior map) bounds it. The mean of 1 / a would count this as drift.
///
/// Along the way odometry lays out the map: its scale (PoseFilter) is only known as well as one
/// renewal of the map shows it, two matches over the distance in between. Its error is the same all
/// along, so that what it leads to grows with distance, not with its root.
///
/// Surfaces that were written long ago, as those of a prior map are or of a place that is seen
/// again, hold the pose, and little drifts; odometry has laid out none of them.
///
/// Called by GridSlam. Beyond what is published, nothing depends on it.
class MapDrift {
 public:
  /// `scale`: of the odometry; `step`: m, over which matches have errors of their own: a cell of
  /// the map.
  MapDrift(const ScalePrior& scale, double step);

  /// The vehicle has moved in the map. `by_odometry`: how far was measured by it.
  void moveTo(const Pose2& base_in_map, bool by_odometry);

  /// A scan that was not matched is written to the map from where moveTo() led, with the covariance
  /// of the prediction. The next match is with what was written so, and does not know its error.
  void writeUnmatched(const Eigen::Matrix3d& covariance) { unmatched_ = covariance; }

  /// A scan is written to the map from where moveTo() led.
  void write(const MatchedScan& scan);

  /// Of the map about the vehicle, in the map's axes: x (m), y (m), heading (rad).
  Eigen::Matrix3d covariance() const { return covariance_.topLeftCorner<3, 3>(); }

  /// Standard deviation of what is not known of odometry's scale.
  double scaleSigma() const;

 private:
  /// Order of the states: the map's pose, and the scale of the odometry.
  enum State { kX, kY, kHeading, kScale, kStates };

  struct Written {
    Stamp stamp;
    double distance = 0.0;  ///< m, driven since the start
  };

  /// What lies between now and the time at which surfaces of this age (s) were written.
  struct Renewal {
    double scans = 1.0;       ///< 1 or more
    double distance = 0.0;    ///< m, as far as it is remembered
    double remembered = 1.0;  ///< 0 to 1, share of the age that is
  };
  Renewal renewalOf(double age) const;

  /// How far the view has moved from one pose to another, m.
  static double moved(const Pose2& from, const Pose2& to, double view_range);
  void learnScale(double variance);

  bool learns_scale_;
  double step_;
  Eigen::Matrix<double, kStates, kStates> covariance_;
  std::optional<Pose2> pose_;
  std::optional<Pose2> since_;  ///< since when the drift has been added up
  double scans_since_ = 0.0;
  double laid_out_ = 1.0;  ///< share of what is seen that was laid out on this drive
  std::optional<Eigen::Matrix3d> unmatched_;  ///< of the last one, until the next match
  std::deque<Written> written_;
};

}  // namespace datmo
