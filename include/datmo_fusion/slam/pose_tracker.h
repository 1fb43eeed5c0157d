// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "datmo_fusion/common/scan.h"
#include "datmo_fusion/common/stamp.h"
#include "datmo_fusion/common/twist2.h"
#include "datmo_fusion/slam/map_recovery.h"
#include "datmo_fusion/slam/odometry_anchor.h"
#include "datmo_fusion/slam/odometry_buffer.h"
#include "datmo_fusion/slam/pose_filter.h"

namespace datmo {

/// Tracks the vehicle's pose from one scan to the next by a PoseFilter: predicted by odometry as
/// far as it has arrived, by the last velocity if odometry is overdue or missing, and over gaps
/// without scans. GridSlam corrects the pose by its matches in between.
///
/// It does not know the maps, only that one may be left: the pose is in the frame of the map that
/// is updated. Not thread-safe.
class PoseTracker {
 public:
  /// What a prediction is based on.
  struct Prediction {
    bool by_odometry = false;  ///< odometry measured most of the motion
    /// Odometry poses that have just resumed contradict the matches since: the pose is again in the
    /// last map in which the vehicle was located (OdometryAnchor).
    bool anchored = false;
  };

  /// s; how long odometry is waited for after the first scan after a gap.
  static constexpr double kOdometryDelay = 0.6;

  /// What continues after the last scan, in another tracker.
  struct State {
    Stamp stamp;
    double scan_interval = 0.0;  ///< s, mean; more than 0
    PoseFilter::Estimate estimate;
    std::vector<OdometrySample> odometry;  ///< from the stamp on
  };

  /// `odometry_hold`: s; how long a sample is used after its stamp. Throws OptionError.
  PoseTracker(const Checked<PoseFilterOptions>& pose, const MotionModelOptions& motion,
              double odometry_hold);

  /// Returns the state at the last scan; none if that scan saw nothing, or it cannot be told yet
  /// how long a gap is.
  std::optional<State> state() const;

  /// Continues from the state of an earlier tracker with the same options, before the first scan.
  /// What lies in between is a gap of scans; the odometry added so far is kept.
  void continueFrom(const State& state);

  /// Adds odometry in ascending stamp order. Without scans, the pose follows it before it is
  /// discarded.
  Prediction addOdometry(const OdometrySample& sample);

  /// Predicts the pose at a scan's stamp, if that is later than the pose's. Call keepScan() before.
  Prediction predictTo(Stamp stamp);

  /// Updates with the pose of a match for which `predicted` was the prior.
  void correct(const PoseFilter& predicted, const PoseWithCovariance& matched);
  /// Undoes that update.
  void discardMatch(const PoseFilter& predicted) { filter_ = predicted; }

  /// Records that the scan of this stamp was taken at the current pose. `saw_anything`: it has
  /// rays; `is_located`: in the map that will stay.
  void keepScan(Stamp stamp, bool saw_anything, bool is_located);

  /// Returns whether the last scan is long ago, and the pose has become much less certain since.
  bool isLostInGap(Stamp stamp, const MapRecoveryOptions& limits) const;

  /// Remembers the pose before the gap that ends at this stamp, if odometry has not arrived for its
  /// end yet.
  void awaitOdometryOfGap(Stamp stamp);

  /// If that odometry has arrived, a little later than the scan, returns to the state before the
  /// gap, from which it now predicts. Returns whether it did. `may_undo`: the old map still exists.
  bool undoGap(Stamp stamp, bool may_undo);

  /// Restarts at this pose, in a map that starts there.
  void restartAt(const PoseWithCovariance& pose) { filter_.restartAt(pose); }
  /// Drops the anchor, which lies in a map that no longer exists.
  void forgetAnchor() { anchor_ = {}; }

  /// Returns the vehicle's twist during `seconds` (more than 0) from this stamp on: by odometry, or
  /// else the last estimate.
  Twist2 twistDuring(Stamp stamp, double seconds) const;

  /// Returns whether there was a scan.
  bool hasBegun() const { return stamp_.has_value(); }
  const PoseFilter& filter() const { return filter_; }
  PoseWithCovariance pose() const { return filter_.pose(); }
  const OdometryBuffer& odometry() const { return odometry_; }

 private:
  Prediction predict(Stamp stamp);
  /// The same if odometry is overdue for the last `seconds` before `stamp`: measured as far as it
  /// goes, then predicted by the velocity, updated by odometry that arrived late.
  void extrapolate(Stamp stamp, double seconds);
  bool isGap(double seconds) const;
  void rememberScan(Stamp stamp);

  /// m/s; used for odometry that does not measure speed.
  double estimatedSpeed() const { return filter_.velocity().forward_speed; }

  OdometryBuffer odometry_;
  OdometryAnchor anchor_;
  PoseFilter filter_;
  Stamp late_odometry_;         ///< stamp of the newest sample when it was last overdue
  std::optional<Stamp> stamp_;  ///< of the pose: the last scan, or odometry since

  /// The last scan with rays, and the pose at that time.
  struct LastScan {
    Stamp stamp;
    PoseFilter filter;
    double interval = 0.0;  ///< s, mean between earlier scans
  };
  std::optional<LastScan> last_scan_;
  std::optional<LastScan> before_gap_;  ///< while odometry for the gap may still arrive
  Stamp gap_end_;                       ///< of the first scan after that gap
};

}  // namespace datmo
