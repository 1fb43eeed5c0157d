// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/slam/odometry_buffer.h"

#include <algorithm>
#include <iterator>

namespace datmo {

void OdometryBuffer::connect(Piece& from, const OdometrySample& to) {
  if (!from.sample.base_in_odom || !to.base_in_odom) {
    return;
  }
  const Twist2 mean = twistOf(from.sample.base_in_odom->inverse() * *to.base_in_odom,
                              secondsBetween(from.sample.stamp, to.stamp));
  if (isPlausible(mean)) {
    from.sample.twist = mean;
    from.to_next = true;
  }
}

void OdometryBuffer::add(const OdometrySample& sample) {
  if (!pieces_.empty()) {
    if (sample.stamp <= pieces_.back().sample.stamp) {
      return;
    }
    connect(pieces_.back(), sample);
  }
  pieces_.push_back({sample});
  while (secondsBetween(pieces_.front().sample.stamp, sample.stamp) > memory_) {
    pieces_.pop_front();
  }
}

std::optional<Pose2> OdometryBuffer::motion(Stamp from, Stamp to, const OdometryErrors& errors,
                                            double assumed_speed) const {
  const auto later =
      std::upper_bound(pieces_.begin(), pieces_.end(), from,
                       [](Stamp stamp, const Piece& piece) { return stamp < piece.sample.stamp; });
  // The first sample also serves for the time just before it.
  auto piece = later == pieces_.begin() ? later : std::prev(later);
  if (piece == pieces_.end() || secondsBetween(from, piece->sample.stamp) > max_hold_) {
    return std::nullopt;
  }
  Pose2 motion;
  Stamp at = from;
  while (at < to) {
    const auto next = std::next(piece);
    const Stamp until = next == pieces_.end() ? to : std::min(to, next->sample.stamp);
    if (!piece->to_next && secondsBetween(piece->sample.stamp, until) > max_hold_) {
      return std::nullopt;
    }
    Twist2 twist = errors.correct(piece->sample.twist);
    twist.forward_speed = piece->sample.speed_measured ? twist.forward_speed : assumed_speed;
    motion = motion * arc(twist, secondsBetween(at, until));
    at = until;
    if (next == pieces_.end()) {
      break;
    }
    piece = next;
  }
  return motion;
}

}  // namespace datmo
