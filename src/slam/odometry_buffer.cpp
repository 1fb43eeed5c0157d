// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/slam/odometry_buffer.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace datmo {

namespace {

/// s; between poses less than this apart a vehicle follows an arc, and sideways motion is rounding;
/// over a longer gap its path may have had any shape.
constexpr double kBentAfter = 1.0;

/// Number of intervals of which the longest is taken.
constexpr std::size_t kRecentIntervals = 4;

}  // namespace

void OdometryBuffer::connect(Piece& from, OdometrySample& to) const {
  from.seconds = secondsBetween(from.sample.stamp, to.stamp);
  if (!from.sample.base_in_odom || !to.base_in_odom) {
    return;
  }
  const Pose2 motion = from.sample.base_in_odom->inverse() * *to.base_in_odom;
  const Twist2 mean = twistOf(motion, from.seconds);
  // A jump to the side is none of a vehicle's twist.
  if (!isPlausible({motion.position().norm() / from.seconds, mean.yaw_rate})) {
    return;
  }
  from.to_next = screwOf(motion);
  if (from.seconds < kBentAfter) {
    (*from.to_next)[1] = 0.0;
  }
  if (!to.twist_measured && from.seconds <= max_hold_) {
    to.twist = mean;
    to.twist_measured = true;
  }
}

void OdometryBuffer::add(const OdometrySample& sample) {
  Piece newest{sample};
  if (!pieces_.empty()) {
    if (sample.stamp <= pieces_.back().sample.stamp) {
      return;
    }
    connect(pieces_.back(), newest.sample);
  }
  pieces_.push_back(newest);
  while (pieces_.size() > 1 && secondsBetween(pieces_[1].sample.stamp, sample.stamp) > memory_) {
    pieces_.pop_front();
  }
}

std::vector<OdometrySample> OdometryBuffer::samplesFrom(Stamp stamp) const {
  std::vector<OdometrySample> samples;
  for (auto piece = pieceAt(stamp); piece != pieces_.end(); ++piece) {
    samples.push_back(piece->sample);
  }
  return samples;
}

OdometryBuffer::Pieces::const_iterator OdometryBuffer::pieceAt(Stamp stamp) const {
  const auto later =
      std::upper_bound(pieces_.begin(), pieces_.end(), stamp,
                       [](Stamp at, const Piece& piece) { return at < piece.sample.stamp; });
  return later == pieces_.begin() ? later : std::prev(later);
}

Pose2 OdometryBuffer::motionIn(const Piece& piece, double seconds, const OdometryErrors& errors,
                               double assumed_speed) {
  if (!piece.to_next) {
    Twist2 twist = errors.correct(piece.sample.twist);
    twist.forward_speed = piece.sample.speed_measured ? twist.forward_speed : assumed_speed;
    return arc(twist, seconds);
  }
  Eigen::Vector3d motion = seconds / piece.seconds * *piece.to_next;
  motion.head<2>() /= 1.0 + errors.speed_scale;
  motion[2] -= errors.yaw_rate_bias * seconds;
  return screw(motion);
}

std::optional<Pose2> OdometryBuffer::motion(Stamp from, Stamp to, const OdometryErrors& errors,
                                            double assumed_speed) const {
  // The first sample also applies to the time just before it.
  auto piece = pieceAt(from);
  if (piece == pieces_.end() || secondsBetween(from, piece->sample.stamp) > max_hold_) {
    return std::nullopt;
  }
  Pose2 motion;
  Stamp at = from;
  while (at < to) {
    const auto next = std::next(piece);
    const Stamp until = next == pieces_.end() ? to : std::min(to, next->sample.stamp);
    const bool held =
        piece->sample.twist_measured && secondsBetween(piece->sample.stamp, until) <= max_hold_;
    if (!piece->to_next && !held) {
      return std::nullopt;
    }
    motion = motion * motionIn(*piece, secondsBetween(at, until), errors, assumed_speed);
    at = until;
    if (next == pieces_.end()) {
      break;
    }
    piece = next;
  }
  return motion;
}

double OdometryBuffer::period() const {
  double longest = 0.0;
  const std::size_t last = pieces_.empty() ? 0 : pieces_.size() - 1;
  for (std::size_t i = last - std::min(last, kRecentIntervals); i < last; ++i) {
    longest = std::max(longest, pieces_[i].seconds);
  }
  return longest;
}

double OdometryBuffer::overdue(Stamp stamp) const {
  if (pieces_.size() < 2) {
    return 0.0;
  }
  return std::max(0.0, secondsBetween(pieces_.back().sample.stamp, stamp) - period());
}

bool OdometryBuffer::hasPoses(Stamp from, Stamp to) const {
  if (pieces_.empty() || from < pieces_.front().sample.stamp || pieces_.back().sample.stamp < to) {
    return false;
  }
  return std::all_of(pieceAt(from), pieces_.end(),
                     [&](const Piece& piece) { return piece.to_next || to <= piece.sample.stamp; });
}

std::optional<Twist2> OdometryBuffer::twistAt(Stamp stamp) const {
  const auto piece = pieceAt(stamp);
  if (piece == pieces_.end() || std::abs(secondsBetween(piece->sample.stamp, stamp)) > max_hold_ ||
      !piece->sample.twist_measured || !piece->sample.speed_measured) {
    return std::nullopt;
  }
  return piece->sample.twist;
}

std::optional<Stamp> OdometryBuffer::lastPose() const {
  if (pieces_.empty() || !pieces_.back().sample.base_in_odom) {
    return std::nullopt;
  }
  return pieces_.back().sample.stamp;
}

}  // namespace datmo
