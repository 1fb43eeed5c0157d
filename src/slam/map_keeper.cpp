// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/slam/map_keeper.h"

#include <stdexcept>
#include <string>
#include <utility>

#include "datmo_fusion/slam/pose_covariance.h"

namespace datmo {

namespace {

/// m^2, rad^2; covariance of the pose at which a map starts: it must not be 0 for matching.
constexpr double kStartVariance = 1e-6;

/// Maximum size of a window in which a prior map is searched: about 250 MB per copy.
constexpr std::size_t kMaxSearchedCells = 4'000'000;

bool isSearchable(const GridWindow& window) {
  return rowMajorSize(window.columns, window.rows) <= kMaxSearchedCells;
}

PoseWithCovariance startOf(const Pose2& pose) {
  return {pose, Eigen::Vector3d::Constant(kStartVariance).asDiagonal()};
}

}  // namespace

MapKeeper::MapKeeper(const Checked<OccupancyMapOptions>& map,
                     const Checked<MapRecoveryOptions>& recovery, const ScalePrior& scale)
    : map_options_(*map),
      recovery_options_(*recovery),
      scale_(scale),
      map_(map),
      drift_(noDrift()),
      drift_of_left_map_(drift_) {}

std::optional<MapKeeper::State> MapKeeper::state() const {
  if (isSearching() || (hasPriorMap() && maps_begun_ > 0)) {
    return std::nullopt;
  }
  return State{drift_.estimate(), frame_covariance_, maps_begun_};
}

void MapKeeper::continueFrom(const State& state, const std::vector<CellEvidence>& window,
                             const Pose2& base_in_map) {
  if (hasPriorMap()) {
    map_ = prior_map_->map;
    map_.setWindow(map_options_.window.window());
  }
  map_.centerOn(base_in_map.position());
  map_.recall(window);
  drift_.continueFrom(state.drift, base_in_map);
  frame_covariance_ = state.frame;
  maps_begun_ = state.maps_begun;
}

void MapKeeper::setPriorMap(PriorMap prior_map) {
  const GridWindow all = prior_map.map.extent();
  if (!isSearchable(all)) {
    throw std::invalid_argument("a map of " + std::to_string(all.columns) + " x " +
                                std::to_string(all.rows) + " cells: expected " +
                                std::to_string(kMaxSearchedCells) + " cells at most");
  }
  prior_map.map.setWindow(all);
  usePriorMap(std::make_shared<const PriorMap>(std::move(prior_map)));
}

void MapKeeper::usePriorMap(std::shared_ptr<const PriorMap> prior_map) {
  prior_map_ = std::move(prior_map);
  if (prior_map_) {
    // It stays as it is, and if the vehicle is not found nearby, all of it is searched.
    recovery_options_.search.max_aligned_sigma = 0.0;
  }
}

PoseWithCovariance MapKeeper::startInPriorMap(Stamp stamp) {
  return searchPriorMap(prior_map_->map, prior_map_->start, stamp);
}

PoseWithCovariance MapKeeper::searchPriorMap(OccupancyMap whole, const SearchRegion& region,
                                             Stamp stamp) {
  recovery_.emplace(recovery_options_, std::move(whole), region, stamp);
  map_ = OccupancyMap(map_options_);
  PoseWithCovariance start = startOf(recovery_->start().pose);
  map_.centerOn(start.pose.position());
  return start;
}

PoseWithCovariance MapKeeper::leave(const PoseWithCovariance& pose, Stamp stamp) {
  if (isSearchingPriorMap()) {
    const SearchRegion region = recovery_->regionOf(pose);
    return searchPriorMap(recovery_->takeOlder(), region, stamp);
  }
  if (isSearchingKidnapped()) {
    recovery_.emplace(MapRecovery::afterKidnapping(recovery_options_, recovery_->takeOlder(),
                                                   recovery_->inOlder(pose), stamp));
  } else if (recovery_) {
    recovery_.emplace(recovery_options_, recovery_->takeOlder(), recovery_->inOlder(pose), stamp);
  } else {
    recovery_.emplace(recovery_options_, std::move(map_), pose, stamp);
    drift_of_left_map_ = drift_;
  }
  map_ = OccupancyMap(map_options_);
  return startOf(pose.pose);
}

PoseWithCovariance MapKeeper::leaveKidnapped(const PoseWithCovariance& pose, Stamp stamp) {
  recovery_.emplace(MapRecovery::afterKidnapping(recovery_options_, std::move(map_), pose, stamp));
  drift_of_left_map_ = drift_;
  map_ = OccupancyMap(map_options_);
  return startOf(pose.pose);
}

void MapKeeper::returnToLeftMap() {
  map_ = recovery_->takeOlder();
  drift_ = recovery_->isInPriorMap() ? noDrift() : drift_of_left_map_;
  if (recovery_->isInPriorMap()) {
    map_.setWindow(map_options_.window.window());
  }
  recovery_.reset();
}

MapKeeper::SearchStep MapKeeper::search(const PoseWithCovariance& pose, Stamp stamp) {
  if (!recovery_) {
    return {};
  }
  if (const auto found = recovery_->advance(map_, pose, stamp)) {
    if (!found->is_unique) {
      return {mergeIntoOlder(found->in_older, pose), false};
    }
    returnToLeftMap();
    map_.centerOn(found->in_older.pose.position());
    return {found->in_older, false};
  }
  if (!recovery_->isOver(stamp)) {
    return {};
  }
  if (prior_map_ && isSearchable(recovery_->older().extent())) {
    OccupancyMap whole = recovery_->takeOlder();
    whole.setWindow(whole.extent());
    recovery_.emplace(recovery_options_, std::move(whole), SearchRegion{{}, true}, stamp);
    return {};
  }
  const PoseWithCovariance origin = recovery_->inOlder({Pose2(), Eigen::Matrix3d::Zero()});
  frame_covariance_ += origin.covariance;
  recovery_.reset();
  ++maps_begun_;
  return {std::nullopt, true};
}

PoseWithCovariance MapKeeper::mergeIntoOlder(const PoseWithCovariance& in_older,
                                             const PoseWithCovariance& in_newer) {
  const OccupancyMap newer = std::move(map_);
  returnToLeftMap();  // with its drift: that of the newer map is part of the alignment's error
  map_.centerOn(in_older.pose.position());
  map_.merge(newer, in_older.pose * in_newer.pose.inverse());
  frame_covariance_ += withLeverArm(in_older.covariance, -in_older.pose.position());
  const double turn = in_older.pose.heading() - in_newer.pose.heading();
  return {in_older.pose, rotated(in_newer.covariance, turn)};
}

PoseWithCovariance MapKeeper::inFirstMap(PoseWithCovariance pose) const {
  if (recovery_) {
    pose = recovery_->inOlder(pose);
  }
  pose.covariance += withLeverArm(frame_covariance_, pose.pose.position());
  return pose;
}

}  // namespace datmo
