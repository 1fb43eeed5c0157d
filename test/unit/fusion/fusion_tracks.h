// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>
#include <string>

#include <Eigen/Core>
#include <gtest/gtest.h>

#include "datmo_fusion/common/random.h"
#include "datmo_fusion/tracking/kalman_filter.h"
#include "datmo_fusion/tracking/track.h"

namespace datmo {

/// A valid track of a car whose box is at its state's position and along its velocity.
inline Track carTrack(double x, double y, double vx, double vy, const std::string& source = "lidar",
                      std::uint32_t id = 1) {
  constexpr double kChance = 1.0 / static_cast<double>(kObjectClasses);
  Track track;
  track.id = id;
  track.state << x, y, vx, vy, 0.0, 0.0;
  TrackState variance;
  variance << 0.04, 0.04, 0.25, 0.25, 0.25, 0.25;
  track.covariance = variance.asDiagonal();
  track.mode_probabilities = {0.9, 0.03, 0.03, 0.03, 0.01};
  track.box = {Pose2(x, y, std::atan2(vy, vx)), 4.5, 1.8};
  track.heading_variance = 0.01;
  track.moving = std::hypot(vx, vy) > 0.0;
  track.class_probabilities.fill(kChance);
  track.existence_probability = 0.9;
  track.age = 2.0;
  track.hits = 20;
  track.sensors = {source};
  track.sources = {{source, id}};
  return track;
}

/// Rotation matrix of a state: of its three vectors.
inline TrackCovariance stateRotation(double angle) {
  const Eigen::Matrix2d rotation = Pose2(0.0, 0.0, angle).rotation();
  TrackCovariance matrix = TrackCovariance::Zero();
  for (int i = 0; i < kTrackState; i += 2) {
    matrix.block<2, 2>(i, i) = rotation;
  }
  return matrix;
}

/// Randomly correlated, with standard deviations over two orders of magnitude.
inline TrackCovariance randomCovariance(Random& random) {
  constexpr double kByItself = 0.1;  // share of each variance
  TrackCovariance root;
  for (int row = 0; row < kTrackState; ++row) {
    const double sigma = std::pow(10.0, random.uniform(-1.0, 1.0));
    for (int column = 0; column < kTrackState; ++column) {
      root(row, column) = random.normal(sigma);
    }
  }
  TrackCovariance covariance = root * root.transpose();
  covariance.diagonal() *= 1.0 + kByItself;
  return covariance;
}

inline StateEstimate randomEstimate(Random& random) {
  StateEstimate estimate;
  for (int i = 0; i < kTrackState; ++i) {
    estimate.mean[i] = random.normal(10.0);
  }
  estimate.covariance = randomCovariance(random);
  return estimate;
}

}  // namespace datmo
