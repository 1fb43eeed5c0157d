// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/fusion/wire/mapem.h"

#include <algorithm>
#include <array>

#include "map_nodes.h"

namespace datmo {

namespace {

/// DF SignalControlZone: only regional extensions.
void skipPreemption(Uper& uper) {
  const bool is_extended = uper.extended();
  skipRegional(uper);
  if (is_extended) {
    uper.skipAdditions();
  }
}

/// DF LaneAttributes: direction, sharing and type; the type's attributes are ignored.
void walkAttributes(Uper& uper, MapLane& lane) {
  constexpr std::int64_t kTypes = 8;
  constexpr unsigned kVehicleBits = 8;
  constexpr unsigned kOtherBits = 16;
  const bool has_regional = uper.present(false);
  walkBits(uper, lane.direction, 2);
  walkBits(uper, lane.sharing, 10);
  if (uper.extended()) {
    uper.skipAddedChoice();
    lane.type = MapLane::kOtherType;
  } else {
    uper.integer(lane.type, 0, kTypes - 1);
    std::int64_t flags = 0;
    if (lane.type != MapLane::kVehicle) {
      walkBits(uper, flags, kOtherBits);
    } else if (uper.extended()) {
      uper.skipLongBits();
    } else {
      walkBits(uper, flags, kVehicleBits);
    }
  }
  if (has_regional) {
    skipRegional(uper);
  }
}

void walkConnection(Uper& uper, MapConnection& connection) {
  const bool has_remote = uper.present(false);
  const bool has_group = uper.present(connection.group.has_value());
  const bool has_class = uper.present(false);
  const bool has_id = uper.present(false);
  const bool has_maneuvers = uper.present(connection.maneuvers.has_value());
  uper.integer(connection.lane, 0, kItsByteMax);
  walk(uper, has_maneuvers, connection.maneuvers, 0, 4095);
  if (has_remote) {
    IntersectionId remote;
    walk(uper, remote);
  }
  walk(uper, has_group, connection.group, 0, kItsByteMax);
  for (const bool is_there : {has_class, has_id}) {
    if (is_there) {
      uper.skipInteger(0, kItsByteMax);
    }
  }
}

void walkLane(Uper& uper, MapLane& lane) {
  const bool is_extended = uper.extended();
  const bool has_name = uper.present(false);
  const bool has_ingress = uper.present(false);
  const bool has_egress = uper.present(false);
  const bool has_maneuvers = uper.present(false);
  const bool has_connections = uper.present(!lane.connections.empty());
  const bool has_overlays = uper.present(false);
  const bool has_regional = uper.present(false);
  uper.integer(lane.id, 0, kItsByteMax);
  if (has_name) {
    skipName(uper);
  }
  for (const bool has_approach : {has_ingress, has_egress}) {
    if (has_approach) {
      uper.skipInteger(0, 15);
    }
  }
  walkAttributes(uper, lane);
  if (has_maneuvers) {
    uper.skipInteger(0, 4095);
  }
  walkNodes(uper, lane);
  if (has_connections) {
    walkList(uper, lane.connections, 1, 16, walkConnection);
  }
  if (has_overlays) {
    skipList(uper, 5, [](Uper& one) { one.skipInteger(0, kItsByteMax); });
  }
  skipEnd(uper, has_regional, is_extended);
}

/// DF Position3D without elevation.
void walkReference(Uper& uper, MapIntersection& intersection) {
  const bool is_extended = uper.extended();
  const bool has_elevation = uper.present(false);
  const bool has_regional = uper.present(false);
  uper.integer(intersection.latitude, -900000000, ItsPosition::kNoLatitude);
  uper.integer(intersection.longitude, -1800000000, ItsPosition::kNoLongitude);
  if (has_elevation) {
    uper.skipInteger(-4096, 61439);
  }
  skipEnd(uper, has_regional, is_extended);
}

void walkIntersectionGeometry(Uper& uper, MapIntersection& intersection) {
  const bool is_extended = uper.extended();
  const bool has_name = uper.present(false);
  const bool has_width = uper.present(intersection.lane_width.has_value());
  const bool has_limits = uper.present(false);
  const bool has_preemption = uper.present(false);
  const bool has_regional = uper.present(false);
  if (has_name) {
    skipName(uper);
  }
  walk(uper, intersection.id);
  uper.integer(intersection.revision, 0, 127);
  walkReference(uper, intersection);
  walk(uper, has_width, intersection.lane_width, 0, 32767);
  if (has_limits) {
    skipSpeedLimits(uper);
  }
  walkList(uper, intersection.lanes, 1, 255, walkLane);
  if (has_preemption) {
    skipList(uper, 32, skipPreemption);
  }
  skipEnd(uper, has_regional, is_extended);
}

/// Ignores everything after the intersections.
void walkMapem(Uper& uper, Mapem& message) {
  constexpr int kBehind = 4;  // road segments, parameters, restrictions, regional
  walk(uper, message.header, ItsHeader::kMapem);
  uper.extended();
  const bool has_minute = uper.present(false);
  const bool has_layer_type = uper.present(false);
  const bool has_layer = uper.present(false);
  const bool has_intersections = uper.present(!message.intersections.empty());
  for (int i = 0; i < kBehind; ++i) {
    uper.present(false);
  }
  if (has_minute) {
    uper.skipInteger(0, 527040);
  }
  uper.integer(message.revision, 0, 127);
  if (has_layer_type) {
    skipEnumerated(uper, 7);
  }
  if (has_layer) {
    uper.skipInteger(0, 100);
  }
  if (has_intersections) {
    walkList(uper, message.intersections, 1, 32, walkIntersectionGeometry);
  }
}

}  // namespace

std::string encode(Mapem message) {
  UperWriter writer;
  walkMapem(writer, message);
  return writer.bytes();
}

Mapem decodeMapem(std::string_view bytes) {
  UperReader reader(bytes);
  Mapem message;
  walkMapem(reader, message);
  return message;
}

}  // namespace datmo
