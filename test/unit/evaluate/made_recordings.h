// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "evaluate/recorded_data.h"
#include "evaluate/score_options.h"

namespace datmo::evaluation {

inline StampedPose poseAt(double seconds, const Pose2& pose) {
  return {Stamp::fromSeconds(seconds), {pose, Eigen::Matrix3d::Zero()}};
}

/// A vehicle that is stationary at the map's origin from 0 s to 10 s.
inline std::vector<StampedPose> standingVehicle() {
  std::vector<StampedPose> poses;
  for (int i = 0; i <= 100; ++i) {
    poses.push_back(poseAt(0.1 * i, Pose2()));
  }
  return poses;
}

/// A car of 4 m x 2 m at (x, y), m, that drives along x at 10 m/s and is visible.
inline RecordedObject carAt(std::uint32_t id, double x, double y = 0.0) {
  RecordedObject car;
  car.state.id = id;
  car.state.classification = ObjectClass::kVehicle;
  car.state.box = {Pose2(x, y, 0.0), 4.0, 2.0};
  car.state.velocity = Point2(10.0, 0.0);
  car.label = "Car";
  car.moving = true;
  car.visible_to = {"scanner"};
  car.lidar_beams = 3;
  return car;
}

inline RecordedTrack movingTrackAt(std::uint32_t id, double x, double y = 0.0) {
  RecordedTrack track;
  track.state.id = id;
  track.state.box.center = Pose2(x, y, 0.0);
  track.state.velocity = Point2(10.0, 0.0);
  track.state.covariance = Eigen::Matrix4d::Identity();
  return track;
}

/// Options under which an object counts however briefly it is present.
inline ScoreOptions optionsForBriefObjects() {
  ScoreOptions options;
  options.truth.min_time_seen = 0.0;
  return options;
}

}  // namespace datmo::evaluation
