// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/slam/map_drift.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "datmo_fusion/common/square.h"

namespace datmo {

namespace {

/// Scans that are remembered; for surfaces older than the first one, the mean rate of these scans
/// is extrapolated.
constexpr std::size_t kMaxWritten = 4096;

/// Matches whose errors add up to that of the distance between them.
constexpr double kMatchesOfADistance = 2.0;

}  // namespace

MapDrift::MapDrift(const ScalePrior& scale, double step)
    : learns_scale_(scale.calibrated), step_(step), covariance_(Covariance::Zero()) {
  covariance_(kScale, kScale) = scale.variance;
}

double MapDrift::scaleSigma() const { return std::sqrt(covariance_(kScale, kScale)); }

void MapDrift::moveTo(const Pose2& base_in_map, bool by_odometry) {
  if (pose_) {
    const Point2 motion = base_in_map.position() - pose_->position();
    Covariance transition = Covariance::Identity();
    // An error of the map's heading rotates the motion.
    transition(kX, kHeading) = -motion.y();
    transition(kY, kHeading) = motion.x();
    if (by_odometry) {
      transition.block<2, 1>(kX, kScale) = -laid_out_ * motion;
    }
    covariance_ = (transition * covariance_ * transition.transpose()).eval();
  }
  pose_ = base_in_map;
}

double MapDrift::moved(const Pose2& from, const Pose2& to, double view_range) {
  return std::max((to.position() - from.position()).norm(),
                  view_range * std::abs(angleBetween(from.heading(), to.heading())));
}

void MapDrift::write(const MatchedScan& scan) {
  const Pose2& pose = scan.base_in_map.pose;
  if (!since_) {
    since_ = pose;
  }
  ++scans_since_;
  Written now{scan.stamp, written_.empty() ? 0.0 : written_.back().distance};
  // Match noise at rest is not motion.
  const double progress = moved(*since_, pose, scan.view_range);
  const bool has_moved = progress >= step_;
  if (has_moved) {
    now.distance += (pose.position() - since_->position()).norm();
    since_ = pose;
  }
  written_.push_back(now);
  if (written_.size() > kMaxWritten) {
    written_.pop_front();
  }
  if (!has_moved) {
    return;
  }
  if (unmatched_) {
    covariance_.topLeftCorner<3, 3>() += *unmatched_;
    unmatched_.reset();
  }
  const Renewal renewal = renewalOf(scan.surface_age);
  covariance_.topLeftCorner<3, 3>() +=
      std::min(1.0, scans_since_ / renewal.scans) * scan.base_in_map.covariance;
  scans_since_ = 0.0;
  laid_out_ = renewal.remembered;
  if (learns_scale_ && renewal.distance > 0.0) {
    const Point2 along = pose.rotate(Point2(1.0, 0.0));
    const double variance = along.dot(scan.base_in_map.covariance.topLeftCorner<2, 2>() * along);
    learnScale(kMatchesOfADistance * variance / square(renewal.distance));
  }
}

MapDrift::Renewal MapDrift::renewalOf(double age) const {
  const Written& now = written_.back();
  const Stamp from = now.stamp + -age;
  const auto first =
      std::lower_bound(written_.begin(), written_.end(), from,
                       [](const Written& written, Stamp stamp) { return written.stamp < stamp; });
  const double span = secondsBetween(written_.front().stamp, now.stamp);
  const double longer = first == written_.begin() && span > 0.0 ? std::max(1.0, age / span) : 1.0;
  return {std::max(1.0, longer * static_cast<double>(written_.end() - first - 1)),
          now.distance - first->distance, 1.0 / longer};
}

void MapDrift::learnScale(double variance) {
  const double known = covariance_(kScale, kScale);
  if (variance < known) {
    const double share = std::sqrt(variance / known);
    covariance_.row(kScale) *= share;
    covariance_.col(kScale) *= share;
  }
}

}  // namespace datmo
