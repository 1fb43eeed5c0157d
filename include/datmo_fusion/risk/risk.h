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

/// Probabilities of contact are given within 1, 2, 3 and 4 s.
inline constexpr std::size_t kRiskTimes = 4;

/// A time that never comes, s.
inline constexpr double kNever = std::numeric_limits<double>::infinity();

/// The id of all that stands and is no track: no track has it.
inline constexpr std::uint32_t kStandingId = 0;

/// The risk of one object: of contact between it and the host, if both go on as they do.
struct ObjectRisk {
  std::uint32_t id = kStandingId;  ///< of the track
  ObjectClass object_class = ObjectClass::kUnknown;
  MotionMode mode = MotionMode::kStanding;               ///< the likeliest one
  std::array<double, kRiskTimes> contact_probability{};  ///< within 1, 2, 3, 4 s; they rise
  double early_ttc = kNever;      ///< s: 5 % quantile of the time to contact, given that there is
  double median_ttc = kNever;     ///< s: 50 % quantile of the same
  double time_to_brake = kNever;  ///< s until only full braking avoids contact; 0: too late
  double brake_threat = 0.0;      ///< required over possible deceleration
  double steer_threat = 0.0;      ///< required over possible lateral acceleration
  double post_encroachment = kNever;    ///< s; 0: they touch
  StruckSide side = StruckSide::kNone;  ///< of the host
  double strike_speed = 0.0;            ///< m/s, of one body over the other at contact
  Point2 contact = Point2::Zero();      ///< m, fixed frame: the object's middle at contact

  /// Within the last of the times.
  double probability() const { return contact_probability.back(); }
};

/// The overall level; values as in RiskArray.msg.
enum class RiskLevel : std::uint8_t { kNone, kInformation, kWarning, kImminent };

/// One lower-case word.
const char* nameOf(RiskLevel level);

/// What became of the tracks of one assessment.
struct RiskCounts {
  std::size_t rejected = 0;     ///< not valid (isValid)
  std::size_t old = 0;          ///< not seen for too long
  std::size_t over_budget = 0;  ///< beyond the most that are assessed: those of least existence
  std::size_t unreachable = 0;  ///< contact is out of the question within the horizon
};

/// The risks at one time.
struct RiskReport {
  Stamp stamp;
  std::vector<ObjectRisk> objects;  ///< by rising id; what stands and is no track first
  RiskLevel level = RiskLevel::kNone;
  std::uint32_t cause = kStandingId;  ///< the object that the level is for
  std::string reason;                 ///< one sentence; empty at level none
  BodyPath host;                      ///< as it is expected to go, without spread
  BodySize host_size;
  RiskCounts counts;
};

}  // namespace datmo
