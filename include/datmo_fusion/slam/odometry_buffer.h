// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <deque>
#include <optional>
#include <vector>

#include "datmo_fusion/common/stamp.h"
#include "datmo_fusion/common/twist2.h"
#include "datmo_fusion/slam/pose_filter.h"

namespace datmo {

/// Odometry older than the newest by this much (s) is no longer used for any scan.
inline constexpr double kOdometryMemory = 10.0;

/// Speed and yaw rate as measured by the vehicle at one time.
struct OdometrySample {
  Stamp stamp;
  Twist2 twist;
  /// Pose of the odometry, if the motion is to be taken from it; otherwise the twist is used.
  std::optional<Pose2> base_in_odom = std::nullopt;
  /// false: only the yaw rate was measured, as by gyroscopes.
  bool speed_measured = true;
  /// false: only the pose is used, not the twist.
  bool twist_measured = true;
};

/// No vehicle is faster (m/s) or turns faster (rad/s): such values are from a broken sensor, or
/// from a pose that jumped.
inline constexpr double kMaxSpeed = 150.0;
inline constexpr double kMaxYawRate = 20.0;

/// Returns whether the twist is within these limits; false for NaN.
inline bool isPlausible(const Twist2& twist) {
  return std::abs(twist.forward_speed) <= kMaxSpeed && std::abs(twist.yaw_rate) <= kMaxYawRate;
}

/// The recent odometry, from which the motion between two scans is composed.
class OdometryBuffer {
 public:
  /// `max_hold`: how long (s) a sample is used after its stamp if no newer one has arrived.
  /// `memory`: how much odometry (s) is kept, plus the sample before.
  OdometryBuffer(double max_hold, double memory) : max_hold_(max_hold), memory_(memory) {}

  /// Adds a sample, in ascending stamp order; one that is not newer than the last is ignored.
  void add(const OdometrySample& sample);

  void clear() { pieces_.clear(); }

  /// Returns the samples from the one that applies at this stamp to the newest.
  std::vector<OdometrySample> samplesFrom(Stamp stamp) const;

  /// Returns the vehicle's motion from one stamp to a later one. Between two samples with poses it
  /// is interpolated evenly from one pose to the other, with sideways motion only over a gap,
  /// however far apart they are: an encoder keeps counting while its messages are lost. Otherwise
  /// each sample's twist holds from its stamp to the next one's. None if the samples do not reach
  /// `to` within the maximum hold time, or start later than `from`. For samples without a measured
  /// speed, `assumed_speed` (m/s) is used, uncorrected.
  std::optional<Pose2> motion(Stamp from, Stamp to, const OdometryErrors& errors = {},
                              double assumed_speed = 0.0) const;

  /// Returns whether all of the motion between these stamps lies between samples with poses.
  bool hasPoses(Stamp from, Stamp to) const;

  /// Returns the twist of the sample that applies at this stamp: the last one before, or else the
  /// first one after it. None if it is further away than the maximum hold time, or incomplete.
  std::optional<Twist2> twistAt(Stamp stamp) const;

  /// Returns the newest sample; null if there is none. Valid until the next add().
  const OdometrySample* newest() const {
    return pieces_.empty() ? nullptr : &pieces_.back().sample;
  }

  /// Returns the time (s) after the newest sample at which the next one is due: the longest of the
  /// last few intervals, because samples may come in bursts. 0 before there are two.
  double period() const;

  /// Returns for how long (s) at this stamp the next sample has been due; since then the newest one
  /// is extrapolated. 0 before that, and before there are two.
  double overdue(Stamp stamp) const;

  /// Returns the stamp of the newest sample with a pose; none without one.
  std::optional<Stamp> lastPose() const;

  /// Returns whether the newest sample has a measured speed; false if there is none.
  bool measuresSpeed() const { return !pieces_.empty() && pieces_.back().sample.speed_measured; }

 private:
  /// What is known about the motion from one sample on.
  struct Piece {
    OdometrySample sample;
    /// The motion to the next sample, measured by the poses (screwOf).
    std::optional<Eigen::Vector3d> to_next = std::nullopt;
    double seconds = 0.0;  ///< to the next sample
  };
  using Pieces = std::deque<Piece>;

  /// Takes the motion between two samples from their poses, if they have any. A sample without a
  /// twist then gets that motion's mean, unless the other one is too old.
  void connect(Piece& from, OdometrySample& to) const;

  /// The piece for this stamp: the last one before, or else the first one after it.
  Pieces::const_iterator pieceAt(Stamp stamp) const;

  /// The motion in `seconds` of a piece.
  static Pose2 motionIn(const Piece& piece, double seconds, const OdometryErrors& errors,
                        double assumed_speed);

  double max_hold_;
  double memory_;
  Pieces pieces_;
};

}  // namespace datmo
