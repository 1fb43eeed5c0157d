// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "wire_bits.h"

#include "datmo_fusion/fusion/wire/mapem.h"
#include "datmo_fusion/fusion/wire/spatem.h"

namespace datmo::samples {

// A SPATEM and a MAPEM by the bits of their fields: ISO/TS 19091 (2018), module DSRC. For each
// field: the value above its minimum, and the bits of the range.

inline WireBits signalHeader(std::uint64_t kind) {
  return WireBits().add(2, 8).add(kind, 8).add(0x00ABCDEF, 32);
}

/// One light: group 3, green until 120.0 s to 130.0 s of the hour, then yellow.
inline WireBits wireSpatem() {
  return signalHeader(4)
      .add(0, 1)         // SPAT, not extended
      .add(0b100, 3)     // time, no name, no region
      .add(1234, 20)     // minute of the year
      .add(0, 5)         // one intersection
      .add(0, 1)         // not extended
      .add(0b011000, 6)  // minute and millisecond
      .add(1, 1)         // its id has a region
      .add(12, 16)
      .add(3456, 16)
      .add(7, 7)        // revision
      .add(0x0400, 16)  // fixed time operation (bit 5)
      .add(1235, 20)    // minute
      .add(59250, 16)   // millisecond
      .add(0, 8)        // one movement
      .add(0, 1)        // not extended
      .add(0, 3)        // no name, assist, region
      .add(3, 8)        // group
      .add(1, 4)        // two events
      .add(0, 1)        // not extended
      .add(0b100, 3)    // timing
      .add(6, 4)        // protected movement
      .add(0b01100, 5)  // last and likely end
      .add(1200, 16)
      .add(1300, 16)
      .add(1250, 16)
      .add(0, 1)
      .add(0, 3)
      .add(8, 4);  // protected clearance
}

/// Up to its lanes: the intersection's position, and 3.5 m.
inline WireBits wireMapemHead() {
  return signalHeader(5)
      .add(0, 1)           // MapData, not extended
      .add(0b00010000, 8)  // intersections alone
      .add(9, 7)           // revision
      .add(0, 5)           // one intersection
      .add(0, 1)           // not extended
      .add(0b01000, 5)     // width of its lanes
      .add(0, 1)           // its id without region
      .add(3456, 16)
      .add(2, 7)     // revision
      .add(0, 1)     // Position3D, not extended
      .add(0b00, 2)  // no elevation, no region
      .add(451900000 + 900000000, 31)
      .add(57200000 + 1800000000, 32)
      .add(350, 15);  // 3.5 m
}

/// Up to its nodes, which are listed (0b00) or computed from another lane (0b01).
inline WireBits wireLaneHead(std::uint64_t optional_fields, std::uint64_t id, std::uint64_t nodes) {
  return WireBits()
      .add(0, 1)  // not extended
      .add(optional_fields, 7)
      .add(id, 8)
      .add(0, 1)       // attributes without region
      .add(0b10, 2)    // into it
      .add(0, 10)      // shared with nobody
      .add(0b0000, 4)  // not extended; for vehicles
      .add(0, 9)       // eight flags, not extended
      .add(nodes, 2);  // not extended, and their kind
}

/// Lane 5: three nodes and two connections.
inline WireBits wireListedLane() {
  return wireLaneHead(0b0000100, 5, 0b00)
      .add(1, 6)  // three nodes
      .add(0, 2)  // not extended, without attributes
      .add(0, 3)  // 20 bits
      .add(500 + 512, 10)
      .add(-200 + 512, 10)
      .add(0, 2)
      .add(2, 3)  // 24 bits
      .add(2000 + 2048, 12)
      .add(0 + 2048, 12)
      .add(0, 2)
      .add(5, 3)  // 32 bits
      .add(30000 + 32768, 16)
      .add(-9000 + 32768, 16)
      .add(1, 4)       // two connections
      .add(0b0100, 4)  // group
      .add(1, 1)       // maneuvers
      .add(11, 8)
      .add(0x800, 12)  // straight on
      .add(3, 8)
      .add(0, 4)
      .add(0, 1)
      .add(12, 8);
}

/// Lane 6: beside lane 5.
inline WireBits wireComputedLane() {
  return wireLaneHead(0, 6, 0b01)
      .add(0, 1)  // not extended
      .add(0, 4)  // no turn, scale, region
      .add(5, 8)
      .add(0, 1)  // small
      .add(0 + 2047, 12)
      .add(1, 1)  // large
      .add(3500 + 32767, 16);
}

inline WireBits wireMapem() {
  return wireMapemHead()
      .add(1, 8)  // two lanes
      .add(wireListedLane())
      .add(wireComputedLane());
}

/// The same two as structures.
inline Spatem spatem() {
  Spatem message;
  message.header.station = 0x00ABCDEF;
  message.minute = 1234;
  SpatIntersection intersection;
  intersection.id = {12, 3456};
  intersection.revision = 7;
  intersection.status = 0x0400;
  intersection.minute = 1235;
  intersection.millisecond = 59250;
  SpatTiming timing;
  timing.min_end = 1200;
  timing.max_end = 1300;
  timing.likely = 1250;
  intersection.movements = {
      {3, {{SignalState::kProtected, timing}, {SignalState::kProtectedClearance, std::nullopt}}}};
  message.intersections = {intersection};
  return message;
}

inline Mapem mapem() {
  Mapem message;
  message.header.station = 0x00ABCDEF;
  message.revision = 9;
  MapIntersection intersection;
  intersection.id.number = 3456;
  intersection.revision = 2;
  intersection.latitude = 451900000;
  intersection.longitude = 57200000;
  intersection.lane_width = 350;
  MapLane lane;
  lane.id = 5;
  lane.direction = MapLane::kIngress;
  lane.nodes = {{false, 500, -200}, {false, 2000, 0}, {false, 30000, -9000}};
  lane.connections = {{11, 0x800, 3}, {12, std::nullopt, std::nullopt}};
  MapLane other;
  other.id = 6;
  other.direction = MapLane::kIngress;
  other.computed = MapComputedLane{5, 0, 3500, false};
  intersection.lanes = {lane, other};
  message.intersections = {intersection};
  return message;
}

}  // namespace datmo::samples
