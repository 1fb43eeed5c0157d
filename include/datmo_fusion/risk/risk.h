// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "datmo_fusion/common/object.h"
#include "datmo_fusion/common/stamp.h"
#include "datmo_fusion/risk/host_motion.h"
#include "datmo_fusion/tracking/track.h"

namespace datmo {

/// Probabilities of contact are reported within 1, 2, 3 and 4 s.
inline constexpr std::size_t kRiskTimes = 4;

/// A time that never comes, s.
inline constexpr double kNever = std::numeric_limits<double>::infinity();

/// The id of all stationary obstacles that are not tracks: no track has it.
inline constexpr std::uint32_t kStandingId = 0;

/// The risk of contact between one object and the host, if both continue as they do.
struct ObjectRisk {
  std::uint32_t id = kStandingId;  ///< of the track
  ObjectClass object_class = ObjectClass::kUnknown;
  MotionMode mode = MotionMode::kStanding;               ///< the likeliest one
  std::array<double, kRiskTimes> contact_probability{};  ///< within 1, 2, 3, 4 s; ascending
  double early_ttc = kNever;            ///< s: 5 % quantile of the time to contact, given contact
  double median_ttc = kNever;           ///< s: 50 % quantile of the same
  double time_to_brake = kNever;        ///< s until only full braking avoids contact; 0: too late
  double brake_threat = 0.0;            ///< required deceleration over the possible one
  double steer_threat = 0.0;            ///< required lateral acceleration over the possible one
  double post_encroachment = kNever;    ///< s; 0: they touch
  StruckSide side = StruckSide::kNone;  ///< of the host
  double strike_speed = 0.0;            ///< m/s, relative speed at contact
  Point2 contact = Point2::Zero();      ///< m, fixed frame: the object's center at contact

  /// Probability of contact within the last of the times.
  double probability() const { return contact_probability.back(); }
};

/// The overall level; values as in RiskArray.msg.
enum class RiskLevel : std::uint8_t { kNone, kInformation, kWarning, kImminent };

/// Returns one lower-case word.
const char* nameOf(RiskLevel level);

/// Counts of tracks that one assessment ignored.
struct RiskCounts {
  std::size_t rejected = 0;     ///< not valid (isValid)
  std::size_t old = 0;          ///< not seen for too long
  std::size_t over_budget = 0;  ///< beyond the maximum number: those of least existence
  std::size_t unreachable = 0;  ///< contact is impossible within the horizon
};

/// The risks at one stamp.
struct RiskReport {
  Stamp stamp;
  std::vector<ObjectRisk>
      objects;  ///< by ascending id; stationary obstacles that are not tracks first
  RiskLevel level = RiskLevel::kNone;
  std::uint32_t cause = kStandingId;  ///< the object that caused the level
  std::string reason;                 ///< one sentence; empty at level none
  BodyPath host;                      ///< its expected path, without random deviations
  BodySize host_size;
  RiskCounts counts;
};

}  // namespace datmo
