// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "datmo_fusion/fusion/wire/its_fields.h"

namespace datmo {

/// The common data dictionary used by a CPM: from V2.2.1 on, subclasses of pedestrians,
/// motorcyclists and animals, and correlations, are encoded differently under the same version
/// number.
enum class ItsDictionary { k211, k221 };

/// DF CartesianCoordinateWithConfidence.
struct CpmCoordinate {
  static constexpr std::int64_t kMin = -131072;  ///< and below
  static constexpr std::int64_t kMax = 131071;   ///< and above
  static constexpr std::int64_t kOutOfRange = 4095;
  static constexpr std::int64_t kNoConfidence = 4096;

  std::int64_t value = 0;                   ///< 0.01 m
  std::int64_t confidence = kNoConfidence;  ///< 0.01 m, 95 %
};

/// DF VelocityComponent.
struct CpmVelocityComponent {
  static constexpr std::int64_t kMin = -16383;  ///< and below
  static constexpr std::int64_t kMax = 16382;   ///< and above
  static constexpr std::int64_t kNoValue = 16383;

  std::int64_t value = kNoValue;                      ///< 0.01 m/s
  std::int64_t confidence = ItsSpeed::kNoConfidence;  ///< as in ItsSpeed
};

/// DF Velocity3dWithConfidence, in the plane.
struct CpmVelocity {
  bool is_polar = false;
  CpmVelocityComponent x;  ///< east
  CpmVelocityComponent y;  ///< north
  ItsSpeed speed;          ///< if polar, and
  ItsAngle course;         ///< from east to north
};

/// DF ObjectClassWithConfidence.
struct CpmClass {
  enum Kind : std::int64_t { kVehicle, kVulnerable, kGroup, kOther, kAdded };
  enum Profile : std::int64_t { kPedestrian, kBicyclist, kMotorcyclist, kAnimal };
  static constexpr std::int64_t kNoConfidence = 101;

  Kind kind = kOther;
  Profile profile = kPedestrian;            ///< of kVulnerable
  std::int64_t confidence = kNoConfidence;  ///< %
};

/// DF PerceivedObject: the fields that we use.
struct CpmObject {
  static constexpr std::int64_t kDimensionOutOfRange = 255;
  static constexpr std::int64_t kNoDimension = 256;
  static constexpr std::int64_t kFullQuality = 15;

  std::optional<std::int64_t> id;
  std::int64_t delay = 0;  ///< ms, from the reference time to the measurement
  CpmCoordinate x;         ///< east of the reference position
  CpmCoordinate y;         ///< north of it
  std::optional<CpmVelocity> velocity;
  std::optional<ItsAngle> heading;      ///< from east to north
  std::optional<std::int64_t> length;   ///< 0.1 m
  std::optional<std::int64_t> width;    ///< 0.1 m
  std::optional<std::int64_t> height;   ///< 0.1 m
  std::optional<std::int64_t> quality;  ///< 0 to 15
  std::vector<CpmClass> classes;        ///< 8 at most; none: not classified
};

/// A collective perception message (ETSI TS 103 324 V2), in the units of the standard: what a
/// station perceives.
struct Cpm {
  static constexpr std::int64_t kMaxSegments = 8;
  static constexpr std::int64_t kMaxObjects = 255;

  ItsHeader header{ItsHeader::kVersion, ItsHeader::kCpm, 0};
  std::int64_t reference_time = 0;  ///< ms, TimestampIts
  ItsPosition position;
  std::int64_t segments = 1;  ///< messages that share the perceived objects; 1: not segmented
  std::int64_t segment = 1;   ///< number of this one
  std::optional<ItsAngle> orientation;  ///< of a vehicle, from north clockwise
  std::int64_t object_count = 0;        ///< number of perceived objects in total
  std::vector<CpmObject> objects;
};

std::string encode(Cpm cpm, ItsDictionary dictionary);

/// Throws WireError.
Cpm decodeCpm(std::string_view bytes, ItsDictionary dictionary);

}  // namespace datmo
