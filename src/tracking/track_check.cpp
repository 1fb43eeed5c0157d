// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/tracking/track_check.h"

#include <algorithm>
#include <cmath>

#include "number_checks.h"

#include "datmo_fusion/common/scan.h"

namespace datmo {

namespace {

bool isPose(const Pose2& pose) {
  return isPosition(pose.position()) && std::isfinite(pose.heading());
}

bool isBox(const Box2& box) {
  return isPose(box.center) && isExtent(box.length) && isExtent(box.width);
}

bool isState(const TrackState& state, const TrackCovariance& covariance) {
  return isPosition(state.head<2>()) && isWithin(state.tail<kTrackState - 2>(), kMaxRate) &&
         isCovariance(covariance) &&
         covariance.diagonal().maxCoeff() <= kMaxCoordinate * kMaxCoordinate;
}

}  // namespace

bool isValid(const Track& track) {
  return isState(track.state, track.covariance) && isBox(track.box) && isExtent(track.height) &&
         isRate(track.yaw_rate) && isAmount(track.heading_variance) &&
         areShares(track.mode_probabilities) && areShares(track.class_probabilities) &&
         isShare(track.existence_probability) && isAmount(track.age) &&
         isAmount(track.since_update) &&
         std::all_of(track.history.begin(), track.history.end(),
                     [](const PathPoint& point) { return isPose(point.pose); });
}

bool isValid(const ViewFan& fan) {
  return isPose(fan.sensor) && std::abs(fan.first_bearing) <= kMaxBearing &&
         std::abs(fan.beam_spacing) <= kMaxBearing && std::isfinite(1.0 / fan.beam_spacing) &&
         std::isfinite(fan.min_range) && std::isfinite(fan.sure_range) &&
         std::isfinite(fan.range) && fan.reach.size() <= kMaxBeams &&
         std::all_of(fan.reach.begin(), fan.reach.end(), isAmount);
}

}  // namespace datmo
