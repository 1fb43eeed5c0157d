// SPDX-License-Identifier: BSD-3-Clause
#include "cpm_skipped.h"

#include "datmo_fusion/fusion/wire/wire_error.h"

namespace datmo {

namespace {

constexpr std::int64_t kTwoBytesMax = 65535;

/// DF CorrelationColumn.
void skipColumn(Uper& uper) {
  const std::int64_t cells = uper.extensibleSize(1, 1, 13);
  for (std::int64_t i = 0; i < cells; ++i) {
    uper.skipInteger(-100, 101);
  }
}

/// DF LowerTriangularPositiveSemidefiniteMatrix.
void skipMatrix(Uper& uper, ItsDictionary dictionary) {
  constexpr std::int64_t kComponents = 13;
  const std::int64_t components = uper.extensibleSize(kComponents, kComponents, kComponents);
  for (std::int64_t i = 0; i < components; ++i) {
    uper.present(false);
  }
  std::int64_t columns = 1;
  if (dictionary == ItsDictionary::k211) {
    uper.integer(columns, 1, kComponents);
  } else {
    columns = uper.extensibleSize(columns, 1, kComponents);
  }
  for (std::int64_t i = 0; i < columns; ++i) {
    skipColumn(uper);
  }
}

/// DF VruClusterInformation.
void skipGroup(Uper& uper) {
  const bool is_extended = uper.extended();
  const bool has_id = uper.present(false);
  if (uper.present(false)) {
    throw WireError("bad_message",
                    "a group of people with a bounding box: ObjectClass of TS 102 894-2 has none");
  }
  const bool has_profiles = uper.present(false);
  if (has_id) {
    uper.skipInteger(0, kItsByteMax);
  }
  uper.skipInteger(0, kItsByteMax);  // their number
  if (has_profiles) {
    uper.skipInteger(0, 15);  // four bits
  }
  if (is_extended) {
    uper.skipAdditions();
  }
}

/// The subclass of people and riders: a number or a name, depending on the dictionary.
void skipSubProfile(Uper& uper, CpmClass::Profile profile, ItsDictionary dictionary) {
  constexpr std::int64_t kNumberMax = 15;
  if (dictionary != ItsDictionary::k211) {
    uper.skipInteger(0, kNumberMax);
  } else if (profile == CpmClass::kBicyclist) {
    uper.skipInteger(0, 9);
  } else if (profile == CpmClass::kMotorcyclist) {
    uper.skipInteger(0, 5);
  } else {
    uper.skipInteger(0, 4);
  }
}

/// DF VruProfileAndSubprofile.
void walkVulnerable(Uper& uper, CpmClass& one, ItsDictionary dictionary) {
  if (uper.extended()) {
    uper.skipAddedChoice();
    one.kind = CpmClass::kAdded;
    return;
  }
  std::int64_t profile = one.profile;
  uper.integer(profile, CpmClass::kPedestrian, CpmClass::kAnimal);
  one.profile = static_cast<CpmClass::Profile>(profile);
  skipSubProfile(uper, one.profile, dictionary);
}

}  // namespace

void skipAccelerationVector(Uper& uper) {
  const bool is_polar = !uper.present(true);
  const bool has_z = uper.present(false);
  if (is_polar) {
    uper.skipInteger(0, 161);  // magnitude
    uper.skipInteger(0, 102);
    ItsAngle direction;
    walk(uper, direction);
  } else {
    skipAcceleration(uper);
    skipAcceleration(uper);
  }
  if (has_z) {
    skipAcceleration(uper);
  }
}

void skipAngularVelocity(Uper& uper) {
  uper.skipInteger(-255, 256);
  uper.skipInteger(0, 7);
}

void skipCorrelations(Uper& uper, ItsDictionary dictionary) {
  std::int64_t matrices = 1;
  uper.integer(matrices, 1, 4);
  for (std::int64_t i = 0; i < matrices; ++i) {
    skipMatrix(uper, dictionary);
  }
}

void skipSensors(Uper& uper) {
  const std::int64_t sensors = uper.extensibleSize(1, 1, 128);
  for (std::int64_t i = 0; i < sensors; ++i) {
    uper.skipInteger(0, kItsByteMax);
  }
}

void skipMapPosition(Uper& uper) {
  const bool is_extended = uper.extended();
  const bool has_reference = uper.present(false);
  const bool has_lane = uper.present(false);
  const bool has_connection = uper.present(false);
  const bool has_distance = uper.present(false);
  if (has_reference) {
    uper.present(false);  // a road segment or an intersection: same encoding
    if (uper.present(false)) {
      uper.skipInteger(0, kTwoBytesMax);  // region
    }
    uper.skipInteger(0, kTwoBytesMax);
  }
  for (const bool is_there : {has_lane, has_connection}) {
    if (is_there) {
      uper.skipInteger(0, kItsByteMax);
    }
  }
  if (has_distance) {
    uper.skipInteger(0, 32767);
    uper.skipInteger(0, 1023);
  }
  if (is_extended) {
    uper.skipAdditions();
  }
}

void walkClass(Uper& uper, CpmClass& one, ItsDictionary dictionary) {
  if (uper.extended()) {
    uper.skipAddedChoice();
    one.kind = CpmClass::kAdded;
    return;
  }
  std::int64_t kind = one.kind;
  uper.integer(kind, CpmClass::kVehicle, CpmClass::kOther);
  one.kind = static_cast<CpmClass::Kind>(kind);
  switch (one.kind) {
    case CpmClass::kVehicle:
      uper.skipInteger(kItsUnknown, kItsAgricultural);
      break;
    case CpmClass::kVulnerable:
      walkVulnerable(uper, one, dictionary);
      break;
    case CpmClass::kGroup:
      skipGroup(uper);
      break;
    case CpmClass::kOther:
    case CpmClass::kAdded:
      uper.skipInteger(0, kItsByteMax);
      break;
  }
}

}  // namespace datmo
