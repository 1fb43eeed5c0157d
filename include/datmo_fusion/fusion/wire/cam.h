// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "datmo_fusion/fusion/wire/its_fields.h"

namespace datmo {

/// A cooperative awareness message (ETSI EN 302 637-2 V1.4.1, TS 103 900 V2: the same bits), in the
/// units of the standard: what a station reports about itself.
struct Cam {
  static constexpr std::int64_t kBackward = 1;
  static constexpr std::int64_t kLengthOutOfRange = 1022;
  static constexpr std::int64_t kNoLength = 1023;
  static constexpr std::int64_t kWidthOutOfRange = 61;
  static constexpr std::int64_t kNoWidth = 62;

  ItsHeader header{ItsHeader::kVersion, ItsHeader::kCam, 0};
  std::int64_t generation_time = 0;  ///< ms, TimestampIts modulo 65,536
  std::int64_t station_type = kItsUnknown;
  ItsPosition position;
  bool is_vehicle = true;  ///< false: a roadside unit, without further data
  ItsAngle heading;
  ItsSpeed speed;
  std::int64_t direction = 2;       ///< forward, backward, not available
  std::int64_t length = kNoLength;  ///< 0.1 m
  std::int64_t width = kNoWidth;    ///< 0.1 m
  bool has_low_frequency = false;   ///< whether a writer adds that container, empty
};

std::string encode(Cam cam);

/// Ignores everything after the fields above. Throws WireError.
Cam decodeCam(std::string_view bytes);

}  // namespace datmo
