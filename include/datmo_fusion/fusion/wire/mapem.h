// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "datmo_fusion/fusion/wire/intersection_fields.h"

namespace datmo {

/// DF NodeXY without attributes: an offset from the node before it (the first one from the
/// intersection's reference point), or a position on the earth.
struct MapNode {
  bool is_geodetic = false;
  std::int64_t x = 0;  ///< 0.01 m to the east; 1e-7 deg of longitude
  std::int64_t y = 0;  ///< 0.01 m to the north; 1e-7 deg of latitude
};

/// DF ComputedLane without rotation and scale: another lane's nodes, translated.
struct MapComputedLane {
  std::int64_t reference = 0;  ///< lane id
  std::int64_t x = 0;          ///< 0.01 m to the east
  std::int64_t y = 0;          ///< 0.01 m to the north
  bool is_changed = false;     ///< also rotated or scaled: not usable
};

/// DF Connection: where a lane leads to, and which signals control it.
struct MapConnection {
  std::int64_t lane = 0;
  std::optional<std::int64_t> maneuvers;  ///< 12 flags, bit 0 the most significant
  std::optional<std::int64_t> group;      ///< signal group
};

/// DF GenericLane.
struct MapLane {
  static constexpr std::int64_t kIngress = 2;  ///< flags of `direction`
  static constexpr std::int64_t kEgress = 1;
  static constexpr std::int64_t kVehicle = 0;  ///< `type` of a lane for vehicles
  static constexpr std::int64_t kOtherType = -1;

  std::int64_t id = 0;
  std::int64_t direction = 0;
  std::int64_t sharing = 0;      ///< 10 flags
  std::int64_t type = kVehicle;  ///< LaneTypeAttributes
  std::vector<MapNode> nodes;    ///< starting at the stop line; empty: none that we can read
  std::optional<MapComputedLane> computed;  ///< instead of nodes
  std::vector<MapConnection> connections;
};

/// DF IntersectionGeometry without speed limits.
struct MapIntersection {
  IntersectionId id;
  std::int64_t revision = 0;
  std::int64_t latitude = ItsPosition::kNoLatitude;    ///< 1e-7 deg, of the reference point
  std::int64_t longitude = ItsPosition::kNoLongitude;  ///< 1e-7 deg
  std::optional<std::int64_t> lane_width;              ///< 0.01 m
  std::vector<MapLane> lanes;                          ///< 1 to 255
};

/// A map message (ETSI TS 103 301 V1.3.1, V2.1.1), in the units of the standard.
struct Mapem {
  ItsHeader header{ItsHeader::kVersion, ItsHeader::kMapem, 0};
  std::int64_t revision = 0;
  std::vector<MapIntersection> intersections;  ///< up to 32; none: of roads between them
};

std::string encode(Mapem message);

/// Skips everything else. Throws WireError.
Mapem decodeMapem(std::string_view bytes);

}  // namespace datmo
