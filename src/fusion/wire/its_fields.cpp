// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/fusion/wire/its_fields.h"

#include <string>

#include "datmo_fusion/fusion/wire/wire_error.h"

namespace datmo {

namespace {

constexpr std::int64_t kStationMax = 4294967295;

}  // namespace

void walkFields(Uper& uper, ItsHeader& header) {
  uper.integer(header.version, 0, kItsByteMax);
  uper.integer(header.message, 0, kItsByteMax);
  uper.integer(header.station, 0, kStationMax);
}

void checkVersion(const ItsHeader& header) {
  if (header.version != ItsHeader::kVersion) {
    throw WireError("other_version", "a message of protocol version " +
                                         std::to_string(header.version) + ": expected 2");
  }
}

void walk(Uper& uper, ItsHeader& header) {
  walkFields(uper, header);
  if (header.message != ItsHeader::kCam && header.message != ItsHeader::kCpm) {
    throw WireError("other_message", "a message of kind " + std::to_string(header.message) +
                                         ": expected CAM (2) or CPM (14)");
  }
  checkVersion(header);
}

void walk(Uper& uper, ItsPosition& position) {
  uper.integer(position.latitude, -900000000, ItsPosition::kNoLatitude);
  uper.integer(position.longitude, -1800000000, ItsPosition::kNoLongitude);
  uper.integer(position.semi_major, 0, ItsPosition::kNoAxis);
  uper.integer(position.semi_minor, 0, ItsPosition::kNoAxis);
  uper.integer(position.major_direction, 0, ItsAngle::kNoValue);
  uper.integer(position.altitude, -100000, ItsPosition::kNoAltitude);
  uper.integer(position.altitude_confidence, 0, 15);
}

void walk(Uper& uper, ItsAngle& angle) {
  uper.integer(angle.value, 0, ItsAngle::kNoValue);
  uper.integer(angle.confidence, 1, ItsAngle::kNoConfidence);
}

void walk(Uper& uper, ItsSpeed& speed) {
  uper.integer(speed.value, 0, ItsSpeed::kNoValue);
  uper.integer(speed.confidence, 1, ItsSpeed::kNoConfidence);
}

void skipAcceleration(Uper& uper) {
  std::int64_t value = 161;
  std::int64_t confidence = 102;
  uper.integer(value, -160, 161);
  uper.integer(confidence, 0, 102);
}

}  // namespace datmo
