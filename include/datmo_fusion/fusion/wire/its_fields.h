// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "datmo_fusion/fusion/earth/local_plane.h"
#include "datmo_fusion/fusion/wire/uper.h"

namespace datmo {

// Fields common to several messages, by ETSI TS 102 894-2 (common data dictionary), in its units.
// They default to "not available".

/// OrdinalNumber1B, Identifier1B and their like.
inline constexpr std::int64_t kItsByteMax = 255;

/// DF ItsPduHeader.
struct ItsHeader {
  static constexpr std::int64_t kVersion = 2;
  static constexpr std::int64_t kCam = 2;
  static constexpr std::int64_t kSpatem = 4;
  static constexpr std::int64_t kMapem = 5;
  static constexpr std::int64_t kCpm = 14;

  std::int64_t version = kVersion;
  std::int64_t message = 0;
  std::int64_t station = 0;
};

/// DF ReferencePosition.
struct ItsPosition {
  static constexpr std::int64_t kNoLatitude = 900000001;
  static constexpr std::int64_t kNoLongitude = 1800000001;
  static constexpr std::int64_t kAxisOutOfRange = 4094;
  static constexpr std::int64_t kNoAxis = 4095;
  static constexpr std::int64_t kNoAltitude = 800001;

  std::int64_t latitude = kNoLatitude;    ///< 1e-7 deg, WGS 84
  std::int64_t longitude = kNoLongitude;  ///< 1e-7 deg
  std::int64_t semi_major = kNoAxis;      ///< 0.01 m, of the 95 % ellipse
  std::int64_t semi_minor = kNoAxis;      ///< 0.01 m
  std::int64_t major_direction = 3601;    ///< ItsAngle::value, from north clockwise
  std::int64_t altitude = kNoAltitude;    ///< 0.01 m, above the ellipsoid
  std::int64_t altitude_confidence = 15;  ///< index into a table
};

/// DF Heading, Wgs84Angle (from north clockwise) and CartesianAngle (from x to y): all have the
/// same bits.
struct ItsAngle {
  static constexpr std::int64_t kTurn = 3600;
  static constexpr std::int64_t kNoValue = 3601;
  static constexpr std::int64_t kOutOfRange = 126;
  static constexpr std::int64_t kNoConfidence = 127;

  std::int64_t value = kNoValue;            ///< 0.1 deg
  std::int64_t confidence = kNoConfidence;  ///< 0.1 deg, 95 %
};

/// DF Speed.
struct ItsSpeed {
  static constexpr std::int64_t kNoValue = 16383;
  static constexpr std::int64_t kOutOfRange = 126;
  static constexpr std::int64_t kNoConfidence = 127;

  std::int64_t value = kNoValue;            ///< 0.01 m/s
  std::int64_t confidence = kNoConfidence;  ///< 0.01 m/s, 95 %
};

/// DE TrafficParticipantType: the first and last vehicle types, and others.
enum ItsStationType : std::int64_t {
  kItsUnknown = 0,
  kItsPedestrian = 1,
  kItsCyclist = 2,
  kItsMoped = 3,
  kItsMotorcycle = 4,
  kItsPassengerCar = 5,
  kItsTram = 11,
  kItsLightVruVehicle = 12,
  kItsAgricultural = 14,
  kItsRoadSide = 15
};

inline constexpr double kItsCentimeter = 0.01;  ///< m; m/s of speeds

/// Returns a position on the ellipsoid; arguments in 1e-7 degrees.
GeodeticPosition geodeticOf(std::int64_t latitude, std::int64_t longitude);

/// For a header of any message type.
void walkFields(Uper& uper, ItsHeader& header);

/// Throws WireError (`other_version`).
void checkVersion(const ItsHeader& header);

/// Throws WireError (`other_version`, `other_message`) unless the message is a CAM or CPM of
/// version 2.
void walk(Uper& uper, ItsHeader& header);
void walk(Uper& uper, ItsPosition& position);
void walk(Uper& uper, ItsAngle& angle);
void walk(Uper& uper, ItsSpeed& speed);

/// DF AccelerationComponent: written as not available, skipped when read.
void skipAcceleration(Uper& uper);

}  // namespace datmo
