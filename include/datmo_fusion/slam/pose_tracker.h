// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "datmo_fusion/common/scan.h"
#include "datmo_fusion/common/stamp.h"
#include "datmo_fusion/common/twist2.h"
#include "datmo_fusion/slam/map_recovery.h"
#include "datmo_fusion/slam/odometry_anchor.h"
#include "datmo_fusion/slam/odometry_buffer.h"
#include "datmo_fusion/slam/pose_filter.h"

namespace datmo {

/// Where the vehicle is from one scan to the next: PoseFilter, predicted by odometry as far as it
/// has come, by the last velocity where it is overdue or there is none, and over gaps in which no
/// scan came. GridSlam corrects the pose by its matches in between.
///
/// Of the maps it knows nothing but that one may be left: the pose is in the frame of that to which
/// scans are written. Not thread safe.
class PoseTracker {
 public:
  /// What a prediction rests on.
  struct Prediction {
    bool by_odometry = false;  ///< it measured most of the motion
    /// The poses of odometry that was silent until now contradict the matches since: the pose is
    /// again that in the last map in which the vehicle was located (OdometryAnchor).
    bool anchored = false;
  };

  /// `odometry_hold`: s; how long a sample serves after its stamp. Throws OptionError.
  PoseTracker(const Checked<PoseFilterOptions>& pose, const MotionModelOptions& motion,
              double odometry_hold);

  /// Odometry in rising stamp order. Without scans the pose goes on with it before it is forgotten.
  Prediction addOdometry(const OdometrySample& sample);

  /// To the stamp of a scan, where that is later than the pose's. To be called after keepScan().
  Prediction predictTo(Stamp stamp);

  /// Takes the pose that a match found from one that was predicted.
  void correct(const PoseFilter& predicted, const PoseWithCovariance& matched);
  /// Takes it back.
  void discardMatch(const PoseFilter& predicted) { filter_ = predicted; }

  /// The scan of this stamp was taken, and the pose is where it was taken. `saw_anything`: it has
  /// rays; `is_located`: in the map that will stay.
  void keepScan(Stamp stamp, bool saw_anything, bool is_located);

  /// Whether the last scan is long ago, and the pose much less certain than then.
  bool isLostInGap(Stamp stamp, const MapRecoveryOptions& limits) const;

  /// Remembers where the vehicle was before the gap that ends at this stamp, if no odometry has
  /// come for its end yet.
  void awaitOdometryOfGap(Stamp stamp);

  /// Where that odometry has come, a little later than the scan: back to before the gap, over which
  /// it now predicts. Returns whether it did. `may_undo`: the map that was left is still there.
  bool undoGap(Stamp stamp, bool may_undo);

  /// The pose in a map that begins at it.
  void restartAt(const PoseWithCovariance& pose) { filter_.restartAt(pose); }
  /// What odometry could lead back to lies in a map that is none any more.
  void forgetAnchor() { anchor_ = {}; }

  /// Of the vehicle during `seconds` (more than 0) from this stamp on: by odometry, else as last
  /// estimated.
  Twist2 twistDuring(Stamp stamp, double seconds) const;

  /// Whether there was a scan.
  bool hasBegun() const { return stamp_.has_value(); }
  const PoseFilter& filter() const { return filter_; }
  PoseWithCovariance pose() const { return filter_.pose(); }
  const OdometryBuffer& odometry() const { return odometry_; }

 private:
  Prediction predict(Stamp stamp);
  /// The same where odometry is overdue since `seconds` before `stamp`, or the last one: measured
  /// as far as it goes, and on from there by the velocity, of which late odometry tells what it
  /// was.
  void extrapolate(Stamp stamp, double seconds);
  bool isGap(double seconds) const;
  void rememberScan(Stamp stamp);

  /// m/s; for odometry that measures none.
  double estimatedSpeed() const { return filter_.velocity().forward_speed; }

  OdometryBuffer odometry_;
  OdometryAnchor anchor_;
  PoseFilter filter_;
  Stamp late_odometry_;         ///< of the newest sample, when it was last overdue
  std::optional<Stamp> stamp_;  ///< of the pose: the last scan, or odometry since

  /// The last scan that saw anything, and the pose then.
  struct LastScan {
    Stamp stamp;
    PoseFilter filter;
    double interval = 0.0;  ///< s, mean of those before
  };
  std::optional<LastScan> last_scan_;
  std::optional<LastScan> before_gap_;  ///< while odometry may still come for it
  Stamp gap_end_;                       ///< of the first scan behind that gap
};

}  // namespace datmo
