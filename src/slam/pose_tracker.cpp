// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/slam/pose_tracker.h"

#include <algorithm>

namespace datmo {

namespace {

/// s; without scans, the pose follows odometry at this delay, before the buffer discards it: a scan
/// may still arrive.
constexpr double kScanDelay = 0.4 * kOdometryMemory;

/// Maximum extrapolated share of a motion that counts as measured.
constexpr double kMaxExtrapolated = 0.5;

/// Scans further apart than this (s), and than this many mean intervals, leave a gap.
constexpr double kMinGap = 0.4;
constexpr double kGapIntervals = 4.0;

/// Weight of the newest interval in the mean.
constexpr double kIntervalShare = 0.1;

}  // namespace

PoseTracker::PoseTracker(const Checked<PoseFilterOptions>& pose, const MotionModelOptions& motion,
                         double odometry_hold)
    : odometry_(odometry_hold, kOdometryMemory), filter_(pose, motion) {}

std::optional<PoseTracker::State> PoseTracker::state() const {
  if (!last_scan_ || last_scan_->stamp != *stamp_ || last_scan_->interval <= 0.0) {
    return std::nullopt;
  }
  return State{*stamp_, last_scan_->interval, filter_.estimate(), odometry_.samplesFrom(*stamp_)};
}

void PoseTracker::continueFrom(const State& state) {
  filter_.continueFrom(state.estimate);
  stamp_ = state.stamp;
  last_scan_.emplace(LastScan{state.stamp, filter_, state.scan_interval});
  const std::vector<OdometrySample> since = odometry_.samplesFrom(state.stamp);
  odometry_.clear();
  for (const OdometrySample& sample : state.odometry) {
    odometry_.add(sample);
  }
  anchor_.keep(state.stamp, filter_, odometry_);
  for (const OdometrySample& sample : since) {
    odometry_.add(sample);
  }
}

PoseTracker::Prediction PoseTracker::addOdometry(const OdometrySample& sample) {
  odometry_.add(sample);
  if (!stamp_ || secondsBetween(*stamp_, sample.stamp) <= 2.0 * kScanDelay) {
    return {};
  }
  const Stamp behind = sample.stamp + -kScanDelay;
  const Prediction prediction = predict(behind);
  stamp_ = behind;
  return prediction;
}

PoseTracker::Prediction PoseTracker::predictTo(Stamp stamp) {
  return stamp > *stamp_ ? predict(stamp) : Prediction();
}

PoseTracker::Prediction PoseTracker::predict(Stamp stamp) {
  const double seconds = secondsBetween(*stamp_, stamp);
  const auto measured = odometry_.motion(*stamp_, stamp, filter_.errors(), estimatedSpeed());
  const double extrapolated = std::min(odometry_.overdue(stamp), seconds);
  if (!measured && isGap(seconds)) {
    filter_.predictGap(seconds, odometry_.twistAt(stamp));
  } else if (!measured) {
    filter_.predictUnmeasured(seconds);
  } else if (!odometry_.measuresSpeed()) {
    filter_.predictTurn(*measured, seconds);
  } else if (extrapolated > 0.0) {
    extrapolate(stamp, extrapolated);
  } else {
    filter_.predictMeasured(*measured, seconds);
  }
  if (const auto corrected = anchor_.correction(stamp, filter_, odometry_)) {
    filter_ = *corrected;
    return {true, true};
  }
  return {measured && odometry_.measuresSpeed() && extrapolated <= kMaxExtrapolated * seconds,
          false};
}

void PoseTracker::extrapolate(Stamp stamp, double seconds) {
  const Stamp due = stamp + -seconds;
  const OdometrySample& newest = *odometry_.newest();
  if (due > *stamp_) {
    const auto measured = odometry_.motion(*stamp_, due, filter_.errors(), estimatedSpeed());
    filter_.predictMeasured(measured.value_or(Pose2()), secondsBetween(*stamp_, due));
  } else if (newest.stamp > late_odometry_ && newest.twist_measured) {
    filter_.observeVelocity(filter_.errors().correct(newest.twist),
                            std::max(0.0, secondsBetween(newest.stamp, *stamp_)));
  }
  late_odometry_ = newest.stamp;
  filter_.predictUnmeasured(seconds);
}

void PoseTracker::correct(const PoseFilter& predicted, const PoseWithCovariance& matched) {
  filter_ = predicted;
  filter_.correct(matched);
}

Twist2 PoseTracker::twistDuring(Stamp stamp, double seconds) const {
  const auto measured =
      odometry_.motion(stamp, stamp + seconds, filter_.errors(), estimatedSpeed());
  return measured ? twistOf(*measured, seconds) : filter_.velocity();
}

void PoseTracker::keepScan(Stamp stamp, bool saw_anything, bool is_located) {
  stamp_ = std::max(stamp, stamp_.value_or(stamp));
  if (is_located) {  // otherwise the pose is in the newer map's frame, the anchor in the older
    anchor_.keep(stamp, filter_, odometry_);
  }
  if (saw_anything) {
    rememberScan(stamp);
  }
}

void PoseTracker::rememberScan(Stamp stamp) {
  double interval = 0.0;
  if (last_scan_) {
    const double seconds = std::max(0.0, secondsBetween(last_scan_->stamp, stamp));
    interval = last_scan_->interval > 0.0
                   ? last_scan_->interval + kIntervalShare * (seconds - last_scan_->interval)
                   : seconds;
  }
  last_scan_.emplace(LastScan{stamp, filter_, interval});
}

bool PoseTracker::isGap(double seconds) const {
  return last_scan_ && last_scan_->interval > 0.0 &&
         seconds > std::max(kMinGap, kGapIntervals * last_scan_->interval);
}

bool PoseTracker::isLostInGap(Stamp stamp, const MapRecoveryOptions& limits) const {
  return last_scan_ && isGap(secondsBetween(last_scan_->stamp, stamp)) &&
         grewWider(last_scan_->filter.pose().covariance, filter_.pose().covariance, limits);
}

void PoseTracker::awaitOdometryOfGap(Stamp stamp) {
  if (!odometry_.twistAt(stamp)) {
    before_gap_ = last_scan_;
    gap_end_ = stamp;
  }
}

bool PoseTracker::undoGap(Stamp stamp, bool may_undo) {
  if (!before_gap_) {
    return false;
  }
  const bool may_come = may_undo && secondsBetween(gap_end_, stamp) < kOdometryDelay;
  if (may_come && !odometry_.twistAt(stamp)) {
    return false;
  }
  if (may_come) {
    filter_ = before_gap_->filter;
    stamp_ = before_gap_->stamp;
    last_scan_ = before_gap_;
  }
  before_gap_.reset();
  return may_come;
}

}  // namespace datmo
