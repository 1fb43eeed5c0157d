// SPDX-License-Identifier: BSD-3-Clause
// What GridSlam does about gaps, and about prior maps.
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "datmo_fusion/slam/grid_slam.h"
#include "datmo_fusion/slam/pose_covariance.h"

namespace datmo {

namespace {

/// Scans further apart than this (s), and than so many times their mean interval, leave a gap.
constexpr double kMinGap = 0.4;
constexpr double kGapIntervals = 4.0;

/// Odometry is waited for this long (s) after the first scan behind a gap.
constexpr double kOdometryDelay = 0.6;

/// Of the pose at which a map begins (m^2, rad^2): for matches it may not be 0.
constexpr double kStartVariance = 1e-6;

/// Of the window in which a prior map is searched: about 250 MB for each copy of it.
constexpr std::size_t kMaxSearchedCells = 4'000'000;

bool isSearchable(const GridWindow& window) {
  return rowMajorSize(window.columns, window.rows) <= kMaxSearchedCells;
}

Eigen::Matrix3d startCovariance() {
  return Eigen::Vector3d(kStartVariance, kStartVariance, kStartVariance).asDiagonal();
}

/// Weight of the newest interval in their mean.
constexpr double kIntervalShare = 0.1;

}  // namespace

bool GridSlam::isGap(double seconds) const {
  return last_scan_ && last_scan_->interval > 0.0 &&
         seconds > std::max(kMinGap, kGapIntervals * last_scan_->interval);
}

void GridSlam::rememberScan(const Scan& scan) {
  if (scan.rays.empty()) {
    return;
  }
  double interval = 0.0;
  if (last_scan_) {
    const double seconds = std::max(0.0, secondsBetween(last_scan_->stamp, scan.stamp));
    interval = last_scan_->interval > 0.0
                   ? last_scan_->interval + kIntervalShare * (seconds - last_scan_->interval)
                   : seconds;
  }
  last_scan_.emplace(LastScan{scan.stamp, filter_, interval});
}

void GridSlam::leaveMapAfterGap(Stamp stamp) {
  if (!last_scan_ || !isGap(secondsBetween(last_scan_->stamp, stamp)) ||
      !grewWider(last_scan_->filter.pose().covariance, filter_.pose().covariance,
                 options_.recovery)) {
    return;
  }
  const PoseWithCovariance prior = filter_.pose();
  if (recovery_ && recovery_->isInPriorMap()) {
    const SearchRegion region = recovery_->regionOf(prior);
    searchPriorMap(recovery_->takeOlder(), region, stamp);
    return;
  }
  if (recovery_) {
    recovery_.emplace(options_.recovery, recovery_->takeOlder(), recovery_->inOlder(prior), stamp);
  } else {
    if (!odometry_.twistAt(stamp)) {
      before_gap_ = last_scan_;
      gap_end_ = stamp;
    }
    recovery_.emplace(options_.recovery, std::move(map_), prior, stamp);
    drift_of_left_map_ = drift_;
  }
  map_ = OccupancyMap(options_.map);
  filter_.restartAt({prior.pose, startCovariance()});
}

void GridSlam::startIn(PriorMap prior_map) {
  const GridWindow all = prior_map.map.extent();
  if (!isSearchable(all)) {
    throw std::invalid_argument("a map of " + std::to_string(all.columns) + " x " +
                                std::to_string(all.rows) + " cells: expected " +
                                std::to_string(kMaxSearchedCells) + " cells at most");
  }
  prior_map.map.setWindow(all);
  prior_map_ = std::make_shared<const PriorMap>(std::move(prior_map));
}

void GridSlam::searchPriorMap(OccupancyMap whole, const SearchRegion& region, Stamp stamp) {
  recovery_.emplace(options_.recovery, std::move(whole), region, stamp);
  map_ = OccupancyMap(options_.map);
  filter_.restartAt({recovery_->start().pose, startCovariance()});
  map_.centerOn(filter_.pose().pose.position());
  anchor_ = {};
}

void GridSlam::undoGapForOdometry(Stamp stamp) {
  if (!before_gap_) {
    return;
  }
  const bool may_come = recovery_ && secondsBetween(gap_end_, stamp) < kOdometryDelay;
  if (may_come && !odometry_.twistAt(stamp)) {
    return;
  }
  if (may_come) {
    returnToMap();
    filter_ = before_gap_->filter;
    stamp_ = before_gap_->stamp;
    last_scan_ = before_gap_;
  }
  before_gap_.reset();
}

void GridSlam::returnToMap() {
  map_ = recovery_->takeOlder();
  drift_ = recovery_->isInPriorMap() ? noDrift() : drift_of_left_map_;
  if (recovery_->isInPriorMap()) {
    map_.setWindow(options_.map.window.window());
  }
  recovery_.reset();
}

void GridSlam::recover(Stamp stamp) {
  if (!recovery_) {
    return;
  }
  if (const auto found = recovery_->advance(map_, filter_.pose(), stamp)) {
    returnToMap();
    filter_.restartAt(*found);
    map_.centerOn(found->pose.position());
    anchor_ = {};  // of the newer map's frame
  } else if (recovery_->isOver(stamp) && prior_map_ && isSearchable(recovery_->older().extent())) {
    OccupancyMap whole = recovery_->takeOlder();
    whole.setWindow(whole.extent());
    recovery_.emplace(options_.recovery, std::move(whole), SearchRegion{{}, true}, stamp);
  } else if (recovery_->isOver(stamp)) {
    const PoseWithCovariance origin = recovery_->inOlder({Pose2(), Eigen::Matrix3d::Zero()});
    frame_covariance_ += origin.covariance;
    anchor_ = {};
    recovery_.reset();
    ++maps_begun_;
  }
}

PoseWithCovariance GridSlam::poseInFirstMap() const {
  PoseWithCovariance pose = recovery_ ? recovery_->inOlder(filter_.pose()) : filter_.pose();
  pose.covariance += carried(frame_covariance_, pose.pose.position());
  return pose;
}

}  // namespace datmo
