#pragma once

#include <deque>
#include <optional>

#include "datmo_fusion/common/stamp.h"
#include "datmo_fusion/slam/pose_filter.h"

namespace datmo {

/// Odometry this much older (s) than the newest serves no scan any more.
inline constexpr double kOdometryMemory = 10.0;

/// Speed and turn rate as the vehicle measured them at one time.
struct OdometrySample {
  Stamp stamp;
  Twist2 twist;
};

/// A short time of odometry, from which the motion between two scans is put together.
class OdometryBuffer {
 public:
  /// `longest_hold`: how long (s) a sample serves after its stamp when no newer one has come.
  /// `memory`: how much of it (s) is kept.
  OdometryBuffer(double longest_hold, double memory)
      : longest_hold_(longest_hold), memory_(memory) {}

  /// Samples in rising stamp order; one that is not newer than the last is left out.
  void add(const OdometrySample& sample);

  /// The vehicle's motion from one stamp to a later one: each sample's twist holds from its stamp
  /// to the next one's. None if the samples do not reach `to` within the longest hold, or begin
  /// later than `from`.
  std::optional<Pose2> motion(Stamp from, Stamp to, const OdometryErrors& errors = {}) const;

 private:
  double longest_hold_;
  double memory_;
  std::deque<OdometrySample> samples_;
};

}  // namespace datmo
