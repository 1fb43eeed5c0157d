// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "datmo_fusion/common/class_belief.h"
#include "datmo_fusion/common/object.h"
#include "datmo_fusion/common/view_fan.h"

namespace datmo {

/// The four motion models of thesis 3.3.4, and standing still, in the order of all mode vectors and
/// matrices.
enum class MotionMode : std::uint8_t {
  kConstantVelocity,
  kConstantAcceleration,
  kLeftTurn,
  kRightTurn,
  kStanding
};
inline constexpr int kMotionModes = 5;

/// State of a tracked object in the fixed frame: x, y (m), vx, vy (m/s), ax, ay (m/s^2).
inline constexpr int kTrackState = 6;
using TrackState = Eigen::Matrix<double, kTrackState, 1>;
using TrackCovariance = Eigen::Matrix<double, kTrackState, kTrackState>;

/// The pose of a track at one time, as published then.
struct PathPoint {
  Stamp stamp;
  Pose2 pose;  ///< of the box, fixed frame
};

/// A track of one source that was fused into a track.
struct SourceTrack {
  std::string source;
  std::uint32_t id = 0;
};

/// One confirmed moving object, followed over time, in the fixed frame.
struct Track {
  std::uint32_t id = 0;  ///< from 1; stable for the track's life, never reused
  TrackState state = TrackState::Zero();
  TrackCovariance covariance = TrackCovariance::Identity();
  std::array<double, kMotionModes> mode_probabilities{};
  Box2 box;               ///< center is the state's position
  double height = 0.0;    ///< m, 0: not measured
  double yaw_rate = 0.0;  ///< rad/s
  /// rad^2, of the box's heading; modulo pi until motion has resolved front and rear.
  double heading_variance = kUnknownHeadingVariance;
  bool moving = false;  ///< false: it has moved, but is standing now
  ClassProbabilities class_probabilities{};
  double existence_probability = 0.0;  ///< over all hypotheses
  double age = 0.0;                    ///< s, since the first object
  double since_update = 0.0;           ///< s, since the last object; more than 0: coasting
  std::uint32_t hits = 0;
  std::vector<std::string> sensors;
  std::vector<std::size_t> objects;  ///< indices in the current list; empty while coasting
  std::vector<PathPoint> history;    ///< oldest first, current pose last
  std::vector<SourceTrack> sources;  ///< if it was fused from several sources

  /// Returns its most likely class; kUnknown if nothing is known.
  ObjectClass objectClass() const { return mostLikelyClass(class_probabilities); }
};

struct TrackList {
  Stamp stamp;
  std::vector<Track> tracks;   ///< by ascending id
  std::vector<ViewFan> views;  ///< of its sensors, fixed frame, one each; empty: unknown
};

}  // namespace datmo
