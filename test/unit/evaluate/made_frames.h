// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "evaluate/evaluation_data.h"

namespace datmo::evaluation {

/// A required object without extent at (x, y), m: all distances to it are those of centers.
inline TrueState truthAt(std::uint32_t id, double x, double y = 0.0) {
  TrueState truth;
  truth.id = id;
  truth.box.center = Pose2(x, y, 0.0);
  return truth;
}

inline TrueState optionalAt(std::uint32_t id, double x, double y = 0.0) {
  TrueState truth = truthAt(id, x, y);
  truth.duty = Duty::kOptional;
  return truth;
}

/// A stationary track at (x, y), m, of unit covariance.
inline TrackState trackAt(std::uint32_t id, double x, double y = 0.0) {
  TrackState track;
  track.id = id;
  track.box.center = Pose2(x, y, 0.0);
  track.covariance = Eigen::Matrix4d::Identity();
  return track;
}

/// Frames one second apart.
class FrameMaker {
 public:
  FrameMaker& add(std::vector<TrueState> truths, std::vector<TrackState> tracks) {
    frames_.push_back({Stamp::fromSeconds(static_cast<double>(frames_.size())), std::move(truths),
                       std::move(tracks)});
    return *this;
  }
  const Frames& frames() const { return frames_; }

 private:
  Frames frames_;
};

/// One stationary object at the origin, and in each frame the track that is exactly on it (0:
/// none).
inline Frames followedBy(const std::vector<std::uint32_t>& tracks) {
  FrameMaker maker;
  for (const std::uint32_t track : tracks) {
    maker.add({truthAt(1, 0.0)}, track == 0 ? std::vector<TrackState>()
                                            : std::vector<TrackState>{trackAt(track, 0.0)});
  }
  return maker.frames();
}

}  // namespace datmo::evaluation
