// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <deque>
#include <optional>

#include "datmo_fusion/common/stamp.h"
#include "datmo_fusion/common/twist2.h"
#include "datmo_fusion/slam/pose_filter.h"

namespace datmo {

/// Odometry this much older (s) than the newest serves no scan any more.
inline constexpr double kOdometryMemory = 10.0;

/// Speed and turn rate as the vehicle measured them at one time.
struct OdometrySample {
  Stamp stamp;
  Twist2 twist;
  /// Pose of the odometry, if the motion is to come from it; without it from the twist.
  std::optional<Pose2> base_in_odom = std::nullopt;
  /// false: the twist's yaw rate alone was measured, as by gyroscopes.
  bool speed_measured = true;
  /// false: the twist is not to be used, the pose alone is.
  bool twist_measured = true;
};

/// No vehicle is faster (m/s) or spins faster (rad/s): what says so is broken, or a pose that
/// jumped.
inline constexpr double kMaxSpeed = 150.0;
inline constexpr double kMaxYawRate = 20.0;

/// Also false for NaN.
inline bool isPlausible(const Twist2& twist) {
  return std::abs(twist.forward_speed) <= kMaxSpeed && std::abs(twist.yaw_rate) <= kMaxYawRate;
}

/// The last time of odometry, from which the motion between two scans is put together.
class OdometryBuffer {
 public:
  /// `max_hold`: how long (s) a sample serves after its stamp when no newer one has come.
  /// `memory`: how much of it (s) is kept, and the sample before.
  OdometryBuffer(double max_hold, double memory) : max_hold_(max_hold), memory_(memory) {}

  /// Samples in rising stamp order; one that is not newer than the last is left out.
  void add(const OdometrySample& sample);

  /// The vehicle's motion from one stamp to a later one. Between two samples with poses it is what
  /// leads from one to the other, evenly and
  /// with sideways motion only over a gap, however long they are apart: an encoder goes on counting
  /// while its messages are lost. Else each sample's twist holds from its stamp to the next one's.
  /// None if the samples do not reach `to` within the longest hold, or begin later than `from`.
  /// Samples without a measured speed go at `assumed_speed` (m/s), which is taken as it is.
  std::optional<Pose2> motion(Stamp from, Stamp to, const OdometryErrors& errors = {},
                              double assumed_speed = 0.0) const;

  /// Whether all of the motion between these stamps lies between samples with poses.
  bool hasPoses(Stamp from, Stamp to) const;

  /// Of the sample that holds at this stamp: the last one before, or else the first one after it.
  /// None if it is further away than the longest hold, or measured not all of it.
  std::optional<Twist2> twistAt(Stamp stamp) const;

  /// The newest sample; null if there is none. Valid until the next add().
  const OdometrySample* newest() const {
    return pieces_.empty() ? nullptr : &pieces_.back().sample;
  }

  /// Time (s) after the newest sample at which the next one is due: the longest of the last few
  /// intervals, since samples may come in bursts. 0 before there are two.
  double period() const;

  /// For how long (s) at this stamp the next sample has been due: what the newest one said is
  /// extrapolated since then. 0 before that, and before there are two.
  double overdue(Stamp stamp) const;

  /// Of the newest sample with a pose; none without one.
  std::optional<Stamp> lastPose() const;

  /// Whether the newest sample has it; false without any.
  bool measuresSpeed() const { return !pieces_.empty() && pieces_.back().sample.speed_measured; }

 private:
  /// What is known of the motion from one sample on.
  struct Piece {
    OdometrySample sample;
    /// Measured by the poses (screwOf), to the next sample.
    std::optional<Eigen::Vector3d> to_next = std::nullopt;
    double seconds = 0.0;  ///< to the next sample
  };
  using Pieces = std::deque<Piece>;

  /// Takes the motion between two samples from their poses, if they have any. A sample without a
  /// twist then has that motion's mean, unless it is too long ago.
  void connect(Piece& from, OdometrySample& to) const;

  /// That holds at this stamp: the last one before, or else the first one after it.
  Pieces::const_iterator pieceAt(Stamp stamp) const;

  /// In `seconds` of a piece's time.
  static Pose2 motionIn(const Piece& piece, double seconds, const OdometryErrors& errors,
                        double assumed_speed);

  double max_hold_;
  double memory_;
  Pieces pieces_;
};

}  // namespace datmo
