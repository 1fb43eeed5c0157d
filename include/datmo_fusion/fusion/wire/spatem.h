// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "datmo_fusion/fusion/wire/intersection_fields.h"

namespace datmo {

/// DF TimeChangeDetails: TimeMark, 0.1 s within the hour, UTC.
struct SpatTiming {
  static constexpr std::int64_t kHour = 36000;     ///< also marks times beyond that
  static constexpr std::int64_t kUnknown = 36001;  ///< mark for an unknown time

  std::optional<std::int64_t> start;
  std::int64_t min_end = kUnknown;
  std::optional<std::int64_t> max_end;
  std::optional<std::int64_t> likely;
  std::optional<std::int64_t> confidence;  ///< of `likely`, index into a table
  std::optional<std::int64_t> next;        ///< when the state recurs
};

/// DE MovementPhaseState.
enum class SignalState {
  kUnavailable,
  kDark,
  kStopThenProceed,
  kStop,
  kPreMovement,
  kPermissive,
  kProtected,
  kPermissiveClearance,
  kProtectedClearance,
  kCaution
};

/// DF MovementEvent without advised speeds.
struct SpatEvent {
  SignalState state = SignalState::kUnavailable;
  std::optional<SpatTiming> timing;
};

/// DF MovementState: what the signals of a group show now, and after that.
struct SpatMovement {
  std::int64_t group = 0;
  std::vector<SpatEvent> events;  ///< 1 to 16
};

/// DF IntersectionState without enabled lanes and queues.
struct SpatIntersection {
  static constexpr std::int64_t kNoMinute = 527040;
  static constexpr std::int64_t kLastMillisecond = 60999;  ///< of a minute with a leap second

  IntersectionId id;
  std::int64_t revision = 0;
  std::int64_t status = 0;             ///< 16 flags, bit 0 the most significant
  std::optional<std::int64_t> minute;  ///< of the year
  std::optional<std::int64_t> millisecond;
  std::vector<SpatMovement> movements;  ///< 1 to 255

  bool hasStatus(unsigned bit) const { return (status >> (15U - bit) & 1) != 0; }
};

/// A signal phase and timing message (ETSI TS 103 301 V1.3.1, V2.1.1), in the units of the
/// standard.
struct Spatem {
  ItsHeader header{ItsHeader::kVersion, ItsHeader::kSpatem, 0};
  std::optional<std::int64_t> minute;           ///< of the year
  std::vector<SpatIntersection> intersections;  ///< 1 to 32
};

std::string encode(Spatem message);

/// Skips everything else. Throws WireError.
Spatem decodeSpatem(std::string_view bytes);

}  // namespace datmo
