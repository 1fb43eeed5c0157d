// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/road/border_track.h"

#include <cmath>

#include <Eigen/LU>

#include "datmo_fusion/common/square.h"

namespace datmo {

namespace {

/// Derivative of the line's offset with respect to the state at the anchor.
Eigen::Vector4d offsetRow(double along) {
  return {1.0, along, along * along / 2.0, along * along * along / 6.0};
}

}  // namespace

void BorderTrackOptions::visit(OptionVisitor& visitor) {
  visitor.number({"offset_drift", "m/m^0.5",
                  "random walk of the border's offset from the clothoid: curbs and parked cars do "
                  "not form one line"},
                 offset_drift, {0.0, 1.0});
  visitor.number({"heading_drift", "rad/m^0.5", "the same for its heading"}, heading_drift,
                 {0.0, 0.1});
  visitor.number({"curvature_drift", "1/m^1.5",
                  "the same for its curvature: bends begin without a clothoid leading into them"},
                 curvature_drift, {0.0, 0.01});
  visitor.number({"curvature_sigma", "1/m", "standard deviation of a new border's curvature"},
                 curvature_sigma, {0.0, 0.1});
  visitor.number(
      {"curvature_rate_sigma", "1/m^2",
       "standard deviation of the rate of change of curvature (Kirchner and Heinrich 1998)"},
      curvature_rate_sigma, {0.0, 0.01});
  visitor.number({"curvature_rate_length", "m",
                  "distance over which curvature keeps changing: roads end a transition within "
                  "some tens of meters"},
                 curvature_rate_length, {1.0, 1000.0});
  visitor.number({"map_drift", "m/s^0.5", "random walk of the map under the vehicle"}, map_drift,
                 {0.0, 1.0});
  visitor.number({"gate", "1", "standard deviations within which a hit belongs to the line"}, gate,
                 {1.0, 10.0});
}

BorderTrack::BorderTrack(const BorderTrackOptions& options, const Pose2& line,
                         const Eigen::Matrix2d& covariance)
    : options_(options), curve_{line, 0.0, 0.0} {
  covariance_.topLeftCorner<2, 2>() = covariance;
  covariance_(2, 2) = square(options.curvature_sigma);
  covariance_(3, 3) = square(options.curvature_rate_sigma);
}

double BorderTrack::wander(double along) const {
  const double distance = std::abs(along);
  const double cube = distance * distance * distance;
  return square(options_.offset_drift) * distance + square(options_.heading_drift) * cube / 3.0 +
         square(options_.curvature_drift) * cube * distance * distance / 20.0;
}

double BorderTrack::varianceAt(double along) const {
  const Eigen::Vector4d row = offsetRow(along);
  return row.dot(covariance_ * row) + wander(along);
}

void BorderTrack::advance(double along, double seconds) {
  const double distance = std::abs(along);
  const double kept = std::exp(-distance / options_.curvature_rate_length);
  Eigen::Matrix4d transition = Eigen::Matrix4d::Identity();
  transition.row(0) = offsetRow(along).transpose();
  transition(1, 2) = along;
  transition(1, 3) = along * along / 2.0;
  transition(2, 3) = along;
  transition.row(3) *= kept;
  curve_ = curve_.movedAlong(along);
  curve_.curvature_rate *= kept;
  arc_length_ += along;

  covariance_ = (transition * covariance_ * transition.transpose()).eval();
  covariance_(0, 0) +=
      square(options_.offset_drift) * distance + square(options_.map_drift) * seconds;
  covariance_(1, 1) += square(options_.heading_drift) * distance;
  covariance_(2, 2) += square(options_.curvature_drift) * distance;
  covariance_(3, 3) += square(options_.curvature_rate_sigma) * (1.0 - kept * kept);
}

int BorderTrack::correct(const std::vector<BorderHit>& hits, double novelty) {
  Eigen::Matrix4d information = Eigen::Matrix4d::Zero();
  Eigen::Vector4d pull = Eigen::Vector4d::Zero();
  int taken = 0;
  for (const BorderHit& hit : hits) {
    const Eigen::Vector4d row = offsetRow(hit.position.along);
    const double variance = hit.variance + wander(hit.position.along);
    const double spread = row.dot(covariance_ * row) + variance;
    if (square(hit.position.aside) > square(options_.gate) * spread) {
      continue;
    }
    information += row * row.transpose() * (novelty / variance);
    pull += row * (hit.position.aside * novelty / variance);
    ++taken;
  }
  if (taken == 0) {
    return 0;
  }
  const Eigen::Matrix4d reduction = Eigen::Matrix4d::Identity() + covariance_ * information;
  covariance_ = (reduction.inverse() * covariance_).eval();
  covariance_ = (0.5 * (covariance_ + covariance_.transpose())).eval();
  const Eigen::Vector4d change = covariance_ * pull;
  curve_.anchor = curve_.anchor * Pose2(0.0, change[0], change[1]);
  curve_.curvature += change[2];
  curve_.curvature_rate += change[3];
  return taken;
}

}  // namespace datmo
