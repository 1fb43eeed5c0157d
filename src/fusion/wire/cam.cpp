// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/fusion/wire/cam.h"

#include <string>

namespace datmo {

namespace {

/// Curvature, how it was found, and yaw rate: not available.
void skipTurning(Uper& uper) {
  std::int64_t curvature = 1023;
  std::int64_t curvature_confidence = 7;
  uper.integer(curvature, -1023, 1023);
  uper.integer(curvature_confidence, 0, 7);
  std::int64_t mode = 2;
  if (uper.extended()) {
    uper.skipSmallNumber();
  } else {
    uper.integer(mode, 0, 2);
  }
  std::int64_t yaw_rate = 32767;
  std::int64_t yaw_rate_confidence = 8;
  uper.integer(yaw_rate, -32766, 32767);
  uper.integer(yaw_rate_confidence, 0, 8);
}

/// DF BasicVehicleContainerHighFrequency, without the optional fields at its end.
void walkVehicle(Uper& uper, Cam& cam) {
  constexpr int kOptional = 7;
  for (int i = 0; i < kOptional; ++i) {
    uper.present(false);
  }
  walk(uper, cam.heading);
  walk(uper, cam.speed);
  uper.integer(cam.direction, 0, 2);
  std::int64_t trailer = 4;  // not available
  uper.integer(cam.length, 1, Cam::kNoLength);
  uper.integer(trailer, 0, 4);
  uper.integer(cam.width, 1, Cam::kNoWidth);
  skipAcceleration(uper);
  skipTurning(uper);
}

/// DF BasicVehicleContainerLowFrequency: a vehicle without special role, lights unknown, empty
/// path. Only for writers: none of it is read.
void writeLowFrequency(Uper& uper) {
  constexpr std::int64_t kPathMax = 40;
  uper.extended();
  uper.skipInteger(0, 0);    // the only container of the choice
  uper.skipInteger(0, 15);   // role
  uper.skipInteger(0, 255);  // lights
  uper.skipInteger(0, kPathMax);
}

void walkCam(Uper& uper, Cam& cam) {
  walk(uper, cam.header);
  uper.integer(cam.generation_time, 0, 65535);
  uper.extended();  // additions come after all that is read, as do the next two
  uper.present(cam.has_low_frequency);
  uper.present(false);  // of special vehicles
  const bool is_basic_extended = uper.extended();
  uper.integer(cam.station_type, 0, 255);
  walk(uper, cam.position);
  if (is_basic_extended) {
    uper.skipAdditions();
  }
  if (uper.extended()) {
    uper.skipAddedChoice();
    cam.is_vehicle = false;
    return;
  }
  cam.is_vehicle = !uper.present(!cam.is_vehicle);
  if (cam.is_vehicle) {
    walkVehicle(uper, cam);
  } else {
    uper.extended();
    uper.present(false);  // protected zones
  }
}

}  // namespace

std::string encode(Cam cam) {
  UperWriter writer;
  walkCam(writer, cam);
  if (cam.has_low_frequency) {
    writeLowFrequency(writer);
  }
  return writer.bytes();
}

Cam decodeCam(std::string_view bytes) {
  UperReader reader(bytes);
  Cam cam;
  walkCam(reader, cam);
  return cam;
}

}  // namespace datmo
