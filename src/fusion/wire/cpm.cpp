// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/fusion/wire/cpm.h"

#include "cpm_skipped.h"

#include "datmo_fusion/fusion/wire/wire_error.h"

namespace datmo {

namespace {

constexpr std::int64_t kMaxContainers = 8;
constexpr std::int64_t kVehicleContainer = 1;
constexpr std::int64_t kObjectContainer = 5;

/// Reads or writes an optional field; `walk_it` walks it.
template <typename Field, typename Walk>
void walkOptional(bool is_there, std::optional<Field>& field, Walk walk_it) {
  if (is_there) {
    field = field.value_or(Field());
    walk_it(*field);
  }
}

void walk(Uper& uper, CpmCoordinate& coordinate) {
  uper.integer(coordinate.value, CpmCoordinate::kMin, CpmCoordinate::kMax);
  uper.integer(coordinate.confidence, 1, CpmCoordinate::kNoConfidence);
}

void walk(Uper& uper, CpmVelocityComponent& component) {
  uper.integer(component.value, CpmVelocityComponent::kMin, CpmVelocityComponent::kNoValue);
  uper.integer(component.confidence, 1, ItsSpeed::kNoConfidence);
}

/// DF CartesianPosition3dWithConfidence.
void walkPosition(Uper& uper, CpmObject& object) {
  const bool has_z = uper.present(false);
  walk(uper, object.x);
  walk(uper, object.y);
  if (has_z) {
    CpmCoordinate z;
    walk(uper, z);
  }
}

/// DF Velocity3dWithConfidence.
void walk(Uper& uper, CpmVelocity& velocity) {
  velocity.is_polar = !uper.present(!velocity.is_polar);
  const bool has_z = uper.present(false);
  if (velocity.is_polar) {
    walk(uper, velocity.speed);
    walk(uper, velocity.course);
  } else {
    walk(uper, velocity.x);
    walk(uper, velocity.y);
  }
  if (has_z) {
    CpmVelocityComponent z;
    walk(uper, z);
  }
}

/// DF EulerAnglesWithConfidence.
void walkAngles(Uper& uper, ItsAngle& heading) {
  const bool has_y = uper.present(false);
  const bool has_x = uper.present(false);
  walk(uper, heading);
  for (const bool is_there : {has_y, has_x}) {
    if (is_there) {
      ItsAngle other;
      walk(uper, other);
    }
  }
}

/// DF ObjectDimension.
void walkDimension(Uper& uper, std::int64_t& dimension) {
  std::int64_t confidence = 32;  // not available
  uper.integer(dimension, 1, CpmObject::kNoDimension);
  uper.integer(confidence, 1, 32);
}

/// DF ObjectClassDescription.
void walkClasses(Uper& uper, std::vector<CpmClass>& classes, ItsDictionary dictionary) {
  constexpr std::int64_t kMostClasses = 8;
  auto size = static_cast<std::int64_t>(classes.size());
  uper.integer(size, 1, kMostClasses);
  classes.resize(static_cast<std::size_t>(size));
  for (CpmClass& one : classes) {
    walkClass(uper, one, dictionary);
    uper.integer(one.confidence, 1, CpmClass::kNoConfidence);
  }
}

/// DF PerceivedObject.
void walk(Uper& uper, CpmObject& object, ItsDictionary dictionary) {
  const bool is_extended = uper.extended();
  const bool has_id = uper.present(object.id.has_value());
  const bool has_velocity = uper.present(object.velocity.has_value());
  const bool has_acceleration = uper.present(false);
  const bool has_angles = uper.present(object.heading.has_value());
  const bool has_angular_velocity = uper.present(false);
  const bool has_correlations = uper.present(false);
  const bool has_height = uper.present(object.height.has_value());
  const bool has_width = uper.present(object.width.has_value());
  const bool has_length = uper.present(object.length.has_value());
  const bool has_age = uper.present(false);
  const bool has_quality = uper.present(object.quality.has_value());
  const bool has_sensors = uper.present(false);
  const bool has_classes = uper.present(!object.classes.empty());
  const bool has_map_position = uper.present(false);

  const auto walk_dimension = [&](std::int64_t& dimension) { walkDimension(uper, dimension); };
  walkOptional(has_id, object.id, [&](std::int64_t& id) { uper.integer(id, 0, 65535); });
  uper.integer(object.delay, -2048, 2047);
  walkPosition(uper, object);
  walkOptional(has_velocity, object.velocity, [&](CpmVelocity& velocity) { walk(uper, velocity); });
  if (has_acceleration) {
    skipAccelerationVector(uper);
  }
  walkOptional(has_angles, object.heading, [&](ItsAngle& heading) { walkAngles(uper, heading); });
  if (has_angular_velocity) {
    skipAngularVelocity(uper);
  }
  if (has_correlations) {
    skipCorrelations(uper, dictionary);
  }
  walkOptional(has_height, object.height, walk_dimension);
  walkOptional(has_width, object.width, walk_dimension);
  walkOptional(has_length, object.length, walk_dimension);
  if (has_age) {
    uper.skipInteger(0, 2047);
  }
  walkOptional(has_quality, object.quality,
               [&](std::int64_t& value) { uper.integer(value, 0, 15); });
  if (has_sensors) {
    skipSensors(uper);
  }
  if (has_classes) {
    walkClasses(uper, object.classes, dictionary);
  }
  if (has_map_position) {
    skipMapPosition(uper);
  }
  if (is_extended) {
    uper.skipAdditions();
  }
}

/// DF ManagementContainer.
void walkManagement(Uper& uper, Cpm& cpm) {
  const bool is_extended = uper.extended();
  const bool is_segmented = uper.present(cpm.segments > 1);
  const bool has_rates = uper.present(false);
  uper.integer(cpm.reference_time, 0, 4398046511103);
  walk(uper, cpm.position);
  if (is_segmented) {
    uper.integer(cpm.segments, 1, Cpm::kMaxSegments);
    uper.integer(cpm.segment, 1, Cpm::kMaxSegments);
  }
  if (has_rates) {
    for (int rate = 0; rate < 2; ++rate) {
      uper.skipInteger(1, 100);
      uper.skipInteger(-5, 2);
    }
  }
  if (is_extended) {
    uper.skipAdditions();
  }
}

/// DF OriginatingVehicleContainer, without the optional fields at its end.
void walkVehicle(Uper& uper, std::optional<ItsAngle>& orientation) {
  constexpr int kOptional = 3;
  uper.extended();
  for (int i = 0; i < kOptional; ++i) {
    uper.present(false);
  }
  walkOptional(true, orientation, [&](ItsAngle& angle) { walk(uper, angle); });
}

/// DF PerceivedObjectContainer.
void walkObjects(Uper& uper, Cpm& cpm, ItsDictionary dictionary) {
  uper.extended();  // additions come after all that is read
  uper.integer(cpm.object_count, 0, Cpm::kMaxObjects);
  const std::int64_t size =
      uper.extensibleSize(static_cast<std::int64_t>(cpm.objects.size()), 0, Cpm::kMaxObjects);
  for (std::int64_t i = 0; i < size; ++i) {
    if (i == static_cast<std::int64_t>(cpm.objects.size())) {
      cpm.objects.emplace_back();  // of a reader: one by one, because the number is not trusted
    }
    walk(uper, cpm.objects[static_cast<std::size_t>(i)], dictionary);
  }
}

/// Everything before the containers.
void walkHead(Uper& uper, Cpm& cpm) {
  walk(uper, cpm.header);
  uper.extended();  // additions come after all that is read
  walkManagement(uper, cpm);
}

}  // namespace

std::string encode(Cpm cpm, ItsDictionary dictionary) {
  UperWriter writer;
  walkHead(writer, cpm);
  std::int64_t vehicle = kVehicleContainer;
  std::int64_t objects = kObjectContainer;
  writer.extensibleSize(cpm.orientation ? 2 : 1, 1, kMaxContainers);
  if (cpm.orientation) {
    writer.integer(vehicle, 1, 16);
    writer.openType([&](Uper& uper) { walkVehicle(uper, cpm.orientation); });
  }
  writer.integer(objects, 1, 16);
  writer.openType([&](Uper& uper) { walkObjects(uper, cpm, dictionary); });
  return writer.bytes();
}

Cpm decodeCpm(std::string_view bytes, ItsDictionary dictionary) {
  UperReader reader(bytes);
  Cpm cpm;
  walkHead(reader, cpm);
  const std::int64_t containers = reader.extensibleSize(0, 1, kMaxContainers);
  for (std::int64_t i = 0; i < containers; ++i) {
    std::int64_t kind = 0;
    reader.integer(kind, 1, 16);
    if (kind == kVehicleContainer) {
      reader.openType([&](Uper& uper) { walkVehicle(uper, cpm.orientation); });
    } else if (kind == kObjectContainer) {
      reader.openType([&](Uper& uper) { walkObjects(uper, cpm, dictionary); });
    } else {
      reader.skipOpenType();
    }
  }
  return cpm;
}

}  // namespace datmo
