// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/fusion/earth/earth_frame_filter.h"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

#include "datmo_fusion/common/covariance_check.h"
#include "datmo_fusion/common/cross.h"
#include "datmo_fusion/common/perpendicular.h"
#include "datmo_fusion/fusion/earth/consistent_pairs.h"

namespace datmo {

namespace {

/// Maximum number of fixes kept for the start; beyond it every second one is dropped.
constexpr std::size_t kMaxFirstFixes = 400;

/// m; minimum distance that counts as driven, so that pose jitter of a standing vehicle is no
/// drift.
constexpr double kMinDrive = 0.5;

Point2 antennaInMap(const EarthFix& fix) { return fix.base_in_map.pose * fix.antenna_in_base; }

/// Covariance of the antenna's position in the map, m^2, from the pose's uncertainty.
Eigen::Matrix2d antennaCovariance(const EarthFix& fix) {
  Eigen::Matrix<double, 2, 3> jacobian;
  jacobian << Eigen::Matrix2d::Identity(),
      perpendicular(fix.base_in_map.pose.rotate(fix.antenna_in_base));
  return jacobian * fix.base_in_map.covariance * jacobian.transpose();
}

}  // namespace

void EarthFrameFilter::reset() {
  first_fixes_.clear();
  has_started_ = false;
  gated_in_a_row_ = 0;
}

std::optional<PoseWithCovariance> EarthFrameFilter::mapInPlane() const {
  return mapInPlane(driven_to_);
}

std::optional<PoseWithCovariance> EarthFrameFilter::mapInPlane(const Pose2& base_in_map) const {
  if (!has_started_) {
    return std::nullopt;
  }
  const Eigen::Matrix3d covariance = driftedTo(base_in_map);
  if (!isCovariance(covariance)) {
    return std::nullopt;  // the vehicle is so far off that no significant digits are left
  }
  return PoseWithCovariance{Pose2(state_(0), state_(1), state_(2)), covariance};
}

void EarthFrameFilter::add(const EarthFix& fix) {
  incorporate(fix);
  restartIfInvalid();
}

void EarthFrameFilter::moveTo(const Pose2& base_in_map) {
  if (has_started_ && (base_in_map.position() - driven_to_.position()).norm() >= kMinDrive) {
    drift(base_in_map);
    restartIfInvalid();
  }
}

/// A pose and a fix with very different magnitudes may leave no significant digits.
void EarthFrameFilter::restartIfInvalid() {
  if (!has_started_) {
    return;
  }
  covariance_ = (0.5 * (covariance_ + covariance_.transpose())).eval();
  if (!state_.allFinite() || !covariance_.allFinite() ||
      !isCovariance<3>(covariance_.topLeftCorner<3, 3>())) {
    ++counts_.restarts;
    reset();
  }
}

void EarthFrameFilter::incorporate(const EarthFix& fix) {
  if (!has_started_) {
    first_fixes_.push_back(fix);
    ++counts_.used;
    start();
    if (!has_started_ && first_fixes_.size() > kMaxFirstFixes) {
      std::vector<EarthFix> thinned;
      for (std::size_t i = 0; i < first_fixes_.size(); i += 2) {
        thinned.push_back(first_fixes_[i]);
      }
      first_fixes_ = std::move(thinned);
    }
    return;
  }
  const bool was_silent = secondsBetween(last_stamp_, fix.stamp) > options_.max_gap;
  predict(fix);
  if (update(fix)) {
    ++counts_.used;
    gated_in_a_row_ = 0;
    return;
  }
  ++counts_.gated;
  if (was_silent || ++gated_in_a_row_ >= options_.restart_after) {
    ++counts_.restarts;
    reset();
  }
}

/// Share of a fix's variance that the fixes shared at first but no longer do.
double EarthFrameFilter::changedShare(const std::vector<EarthFix>& fixes) const {
  const double seconds = secondsBetween(fixes.front().stamp, fixes.back().stamp);
  return options_.correlated_share * (1.0 - std::exp(-seconds / options_.correlation_time));
}

/// Variance of the map's drift from the mean of the fixes to the first or last one, along one axis,
/// m^2: a third of a random walk's variance from end to end. `lever`: m^2, of the rotation.
double EarthFrameFilter::driftAmong(const std::vector<EarthFix>& fixes, double lever) const {
  double distance = 0.0;
  for (std::size_t i = 1; i < fixes.size(); ++i) {
    distance += (antennaInMap(fixes[i]) - antennaInMap(fixes[i - 1])).norm();
  }
  return distance *
         (options_.map_drift * options_.map_drift + options_.map_turn * options_.map_turn * lever) /
         3.0;
}

std::optional<EarthFrameFilter::Start> EarthFrameFilter::startOf(
    const std::vector<EarthFix>& fixes) const {
  if (fixes.size() < static_cast<std::size_t>(options_.start_fixes)) {
    return std::nullopt;
  }
  Start start;
  for (const EarthFix& fix : fixes) {
    const double weight = 1.0 / (0.5 * fix.covariance.trace());
    start.weights += weight;
    start.mean_in_plane += weight * fix.in_plane;
    start.mean_in_map += weight * antennaInMap(fix);
  }
  start.mean_in_plane /= start.weights;
  start.mean_in_map /= start.weights;
  double along = 0.0;
  double across = 0.0;
  double spread = 0.0;  // m^2 weighted
  for (const EarthFix& fix : fixes) {
    const double weight = 1.0 / (0.5 * fix.covariance.trace());
    const Point2 a = antennaInMap(fix) - start.mean_in_map;
    const Point2 b = fix.in_plane - start.mean_in_plane;
    along += weight * a.dot(b);
    across += weight * cross(a, b);
    spread += weight * a.squaredNorm();
  }
  // Within the correlation time the shared error causes no rotation; the part of it that changes
  // meanwhile acts like the rest of a fix's error, but counts only once for all fixes. So does the
  // map's drift.
  start.count = static_cast<double>(fixes.size());
  start.drift = driftAmong(fixes, spread / start.weights);
  const double inflation = (1.0 - options_.correlated_share) + changedShare(fixes) * start.count +
                           start.drift * start.weights;
  start.heading = std::atan2(across, along);
  start.heading_variance = inflation / spread;
  if (spread < options_.start_spread * options_.start_spread * start.weights ||
      std::sqrt(start.heading_variance) > options_.start_heading_sigma) {
    return std::nullopt;
  }
  return start;
}

/// Least squares over the consistent first fixes; their shared error shifts all of them.
void EarthFrameFilter::start() {
  const auto first = startOf(first_fixes_);
  if (!first) {
    return;
  }
  // Compares the fixes with each other, without their shared error.
  const double share = 1.0 - options_.correlated_share + changedShare(first_fixes_);
  std::vector<PointPair> pairs;
  for (const EarthFix& fix : first_fixes_) {
    const double fix_variance = 0.5 * fix.covariance.trace();
    const double antenna_variance = 0.5 * antennaCovariance(fix).trace();
    pairs.push_back(
        {antennaInMap(fix), fix.in_plane, share * fix_variance + antenna_variance + first->drift});
  }
  const ConsistentPairs consistent = consistentPairs(pairs, options_.gate);
  std::vector<EarthFix> fixes;
  for (std::size_t i = 0; i < first_fixes_.size(); ++i) {
    if (consistent.fits[i]) {
      fixes.push_back(first_fixes_[i]);
    }
  }
  const auto found = startOf(fixes);
  if (!found || static_cast<double>(fixes.size()) <
                    options_.start_share * static_cast<double>(first_fixes_.size())) {
    return;
  }
  const std::size_t left_out = first_fixes_.size() - fixes.size();
  counts_.used -= left_out;
  counts_.gated += left_out;
  last_stamp_ = first_fixes_.back().stamp;
  driven_to_ = first_fixes_.back().base_in_map.pose;
  first_fixes_.clear();
  begin(*found, std::max(1.0, consistent.variance_factor));
}

/// `factor`: ratio of the residuals' variance to the expected one.
void EarthFrameFilter::begin(const Start& start, double factor) {
  const Pose2 turned_map(0.0, 0.0, start.heading);
  const double heading_variance = factor * start.heading_variance;
  const double mean_variance = start.count / start.weights;  // m^2, of one fix along one axis
  const double shared = options_.correlated_share * mean_variance;
  const Point2 arm = perpendicular(turned_map.rotate(start.mean_in_map));
  state_.setZero();
  state_.head<2>() = start.mean_in_plane - turned_map.rotate(start.mean_in_map);
  state_(2) = start.heading;
  covariance_.setZero();
  covariance_.topLeftCorner<2, 2>() =
      Eigen::Matrix2d::Identity() *
      (factor * (1.0 - options_.correlated_share) * mean_variance / start.count + start.drift +
       shared);
  // Position and heading are uncorrelated at the mean antenna position in the map.
  covariance_.topLeftCorner<2, 2>() += arm * arm.transpose() * heading_variance;
  covariance_.block<2, 1>(0, 2) = -arm * heading_variance;
  covariance_.block<1, 2>(2, 0) = -arm.transpose() * heading_variance;
  covariance_(2, 2) = heading_variance;
  // The shared error is in the position with the opposite sign.
  covariance_.bottomRightCorner<2, 2>() = shared * Eigen::Matrix2d::Identity();
  covariance_.block<2, 2>(0, 3) = -shared * Eigen::Matrix2d::Identity();
  covariance_.block<2, 2>(3, 0) = -shared * Eigen::Matrix2d::Identity();
  has_started_ = true;
}

/// The covariance of the map's pose including the drift of a straight drive from driven_to_.
Eigen::Matrix3d EarthFrameFilter::driftedTo(const Pose2& base_in_map) const {
  const double distance = (base_in_map.position() - driven_to_.position()).norm();
  const Pose2 map(state_(0), state_(1), state_(2));
  Eigen::Vector3d turn;  // about the vehicle
  turn << -perpendicular(map.rotate(base_in_map.position())), 1.0;
  Eigen::Matrix3d covariance = covariance_.topLeftCorner<3, 3>();
  covariance += distance * options_.map_turn * options_.map_turn * turn * turn.transpose();
  covariance.topLeftCorner<2, 2>() +=
      distance * options_.map_drift * options_.map_drift * Eigen::Matrix2d::Identity();
  return covariance;
}

void EarthFrameFilter::drift(const Pose2& base_in_map) {
  covariance_.topLeftCorner<3, 3>() = driftedTo(base_in_map);
  driven_to_ = base_in_map;
}

void EarthFrameFilter::predict(const EarthFix& fix) {
  const double seconds = secondsBetween(last_stamp_, fix.stamp);
  const double kept = std::exp(-seconds / options_.correlation_time);
  const double shared = options_.correlated_share * 0.5 * fix.covariance.trace();
  Covariance transition = Covariance::Identity();
  transition.bottomRightCorner<2, 2>() *= kept;
  state_.tail<2>() *= kept;
  covariance_ = transition * covariance_ * transition.transpose();
  covariance_.bottomRightCorner<2, 2>() +=
      shared * (1.0 - kept * kept) * Eigen::Matrix2d::Identity();
  drift(fix.base_in_map.pose);
  last_stamp_ = fix.stamp;
}

bool EarthFrameFilter::update(const EarthFix& fix) {
  const Pose2 map(state_(0), state_(1), state_(2));
  const Point2 antenna = antennaInMap(fix);
  Eigen::Matrix<double, 2, kState> jacobian;
  jacobian << Eigen::Matrix2d::Identity(), perpendicular(map.rotate(antenna)),
      Eigen::Matrix2d::Identity();
  const Eigen::Matrix2d noise =
      (1.0 - options_.correlated_share) * fix.covariance +
      map.rotation() * antennaCovariance(fix) * map.rotation().transpose();
  const Point2 residual = fix.in_plane - map * antenna - state_.tail<2>();
  const Eigen::Matrix2d inverse = (jacobian * covariance_ * jacobian.transpose() + noise).inverse();
  if (residual.dot(inverse * residual) > options_.gate) {
    return false;
  }
  const Eigen::Matrix<double, kState, 2> gain = covariance_ * jacobian.transpose() * inverse;
  state_ += gain * residual;
  state_(2) = normalizeAngle(state_(2));
  const Covariance left = Covariance::Identity() - gain * jacobian;  // Joseph's form
  covariance_ = left * covariance_ * left.transpose() + gain * noise * gain.transpose();
  return true;
}

}  // namespace datmo
