// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "wire_bits.h"

#include "datmo_fusion/common/stamp.h"

namespace datmo::samples {

// A CAM and CPMs by the bits of their fields: ETSI EN 302 637-2 V1.4.1, TS 103 324 V2.1.1, TS 102
// 894-2. For each field: the value above its minimum, and the bits of the range.

/// 45.19 deg north (minimum -90), 5.72 deg east (minimum -180); ellipse of 1.5 m and 1.0 m, its
/// major axis 30 deg from north; 212.5 m high (minimum -1000), within 0.5 m.
inline WireBits wirePosition() {
  return WireBits()
      .add(451900000 + 900000000, 31)
      .add(57200000 + 1800000000, 32)
      .add(150, 12)
      .add(100, 12)
      .add(300, 12)
      .add(21250 + 100000, 20)
      .add(5, 4);
}

/// Of a car at 20 m/s to the east, 4.3 m long and 1.8 m wide, up to the heading.
inline WireBits wireCamHead(std::uint64_t optional_containers, std::uint64_t station_type) {
  return WireBits()
      .add(2, 8)                    // protocol version
      .add(2, 8)                    // CAM
      .add(0xCAFE1234, 32)          // station
      .add(34567, 16)               // generation time
      .add(0, 1)                    // not extended
      .add(optional_containers, 2)  // low frequency, special vehicles
      .add(0, 1)                    // basic container, not extended
      .add(station_type, 8)
      .add(wirePosition());
}

inline WireBits wireCam(std::uint64_t heading = 900, std::uint64_t speed = 2000,
                        std::uint64_t direction = 0) {
  return wireCamHead(0, 5)
      .add(0, 1)               // a container that is known
      .add(0, 1)               // of a vehicle
      .add(0, 7)               // nothing optional in it
      .add(heading, 12)        // 0.1 deg
      .add(10 - 1, 7)          // within 1 deg
      .add(speed, 14)          // 0.01 m/s
      .add(50 - 1, 7)          // within 0.5 m/s
      .add(direction, 2)       // forward
      .add(43 - 1, 10)         // length
      .add(4, 3)               // a trailer: not available
      .add(18 - 1, 6)          // width
      .add(161 + 160, 9)       // acceleration: not available
      .add(102, 7)             //
      .add(1023 + 1023, 11)    // curvature: not available
      .add(7, 3)               //
      .add(0, 1)               // its mode is a known one
      .add(2, 2)               // not available
      .add(32767 + 32766, 16)  // yaw rate: not available
      .add(8, 4);
}

/// 2026-03-01 12:00:00 UTC, of the CPMs.
inline const Stamp kWireNoon = Stamp::fromSeconds(1772366400.0);

/// Up to the reference position. 2026-03-01 12:00:00 UTC: 699,451,200 s after 2004 began, and five
/// leap seconds.
inline WireBits wireCpmHead(std::uint64_t extended, std::uint64_t segmented, std::uint64_t rates) {
  return WireBits()
      .add(2, 8)
      .add(14, 8)
      .add(77, 32)
      .add(0, 1)         // payload, not extended
      .add(extended, 1)  // management container
      .add(segmented, 1)
      .add(rates, 1)
      .add(699451205000, 42)
      .add(wirePosition());
}

/// A pedestrian, number 41, 12.34 m east and 5.67 m south, 100 ms before the reference time, at
/// 1.2 m/s to the west.
inline WireBits wirePedestrian() {
  return WireBits()
      .add(0, 1)                  // not extended
      .add(0b11010001101010, 14)  // number, velocity, angles, width, length, quality, class
      .add(41, 16)
      .add(2048 - 100, 12)
      .add(0, 1)  // no z
      .add(1234 + 131072, 18)
      .add(20 - 1, 12)  // within 0.2 m
      .add(131072 - 567, 18)
      .add(30 - 1, 12)
      .add(1, 1)  // velocity by components
      .add(0, 1)
      .add(16383 - 120, 15)
      .add(30 - 1, 7)
      .add(16383 - 0, 15)
      .add(40 - 1, 7)
      .add(0, 2)  // no other angles
      .add(1800, 12)
      .add(126 - 1, 7)  // the heading is out of range
      .add(6 - 1, 8)    // width
      .add(32 - 1, 5)
      .add(5 - 1, 8)  // length
      .add(32 - 1, 5)
      .add(12, 4)  // quality
      .add(1 - 1, 3)
      .add(0, 1)  // a class that is known
      .add(1, 2)  // vulnerable
      .add(0, 1)  // a profile that is known
      .add(0, 2)  // pedestrian
      .add(1, 4)  // ordinary
      .add(80 - 1, 7);
}

/// With that pedestrian alone.
inline WireBits wireCpm() {
  return wireCpmHead(0, 0, 0)
      .add(0, 1)      // a number of containers in the root
      .add(1 - 1, 3)  // 1
      .add(5 - 1, 4)  // objects
      .addOpen(WireBits()
                   .add(0, 1)  // not extended
                   .add(1, 8)  // perceived altogether
                   .add(0, 1)  // a number in the root
                   .add(1, 8)
                   .add(wirePedestrian()));
}

/// Its position, with z, and how it moves: all fields.
inline WireBits wireRichMotion() {
  WireBits object;
  object.add(1, 1).add(131072, 18).add(99, 12).add(131072 + 100, 18).add(99, 12);
  object.add(131072 + 3, 18).add(4095, 12);  // z
  object.add(0, 1)
      .add(1, 1)
      .add(500, 14)
      .add(9, 7)
      .add(900, 12)
      .add(9, 7)  // polar velocity
      .add(16383, 15)
      .add(126, 7);
  object.add(1, 1).add(1, 1).add(160, 9).add(5, 7).add(160, 9).add(5, 7).add(160, 9).add(5, 7);
  object.add(0b11, 2).add(450, 12).add(3, 7).add(0, 12).add(3, 7).add(0, 12).add(3, 7);
  object.add(255, 9).add(7, 3);  // angular velocity
  return object;
}

/// One matrix, of three components in two columns. `is_old`: see wireRichCpm().
inline WireBits wireRichCorrelations(bool is_old) {
  WireBits object;
  object.add(0, 2);
  object.add(0, 1).add(0b1101000000000, 13);
  if (!is_old) {
    object.add(0, 1);
  }
  object.add(2 - 1, 4);
  object.add(0, 1).add(2 - 1, 4).add(100, 8).add(150, 8);
  object.add(0, 1).add(1 - 1, 4).add(201, 8);
  return object;
}

/// Six classes: all kinds, and one that is not known. `is_old`: see wireRichCpm().
inline WireBits wireRichClasses(bool is_old) {
  WireBits object;
  object.add(6 - 1, 3);                                                     // classes
  object.add(0, 1).add(0, 2).add(5, 4).add(50 - 1, 7);                      // a car
  object.add(0, 1).add(1, 2).add(0, 1).add(1, 2).add(1, 4).add(20 - 1, 7);  // bicyclist
  object.add(0, 1)
      .add(1, 2)
      .add(0, 1)
      .add(2, 2)
      .add(2, is_old ? 3 : 4)
      .add(10 - 1, 7);  // motorcycle
  object.add(0, 1).add(2, 2).add(0, 1).add(0b101, 3).add(9, 8).add(4, 8).add(0xA, 4).add(5 - 1, 7);
  object.add(0, 1).add(3, 2).add(1, 8).add(5 - 1, 7);                        // other
  object.add(1, 1).add(0, 7).addOpen(WireBits().add(3, 8)).add(101 - 1, 7);  // not known
  return object;
}

/// An object with all optional fields, all of them extended where possible. `is_old`: see
/// wireRichCpm().
inline WireBits wireRichObject(bool is_old) {
  WireBits object;
  object.add(1, 1).add(0x3FFF, 14);  // extended, all there
  object.add(7, 16).add(2048 + 50, 12);
  object.add(wireRichMotion()).add(wireRichCorrelations(is_old));
  object.add(14, 8).add(31, 5).add(17, 8).add(31, 5).add(42, 8).add(31, 5);  // height...length
  object.add(1500, 11).add(15, 4);
  object.add(0, 1).add(2 - 1, 7).add(1, 8).add(2, 8);  // sensors
  object.add(wireRichClasses(is_old));
  object.add(0, 1).add(0b1111, 4);  // position in a map
  object.add(1, 1).add(1, 1).add(300, 16).add(400, 16).add(5, 8).add(6, 8).add(7, 15).add(8, 10);
  object.add(0, 7).add(1, 1).addOpen(WireBits().add(0xFF, 8));  // an addition
  return object;
}

/// Two objects in a vehicle's CPM: a rich one, and a position alone. `is_old`: by the data
/// dictionary of version 2.1.1.
inline WireBits wireRichCpm(bool is_old) {
  WireBits objects;
  objects.add(0, 1).add(2, 8).add(0, 1).add(2, 8).add(wireRichObject(is_old));
  WireBits second;  // a number, and where it is
  second.add(0, 1).add(0x2000, 14).add(8, 16).add(2048, 12);
  second.add(0, 1).add(131072 - 1, 18).add(4095, 12).add(131072 + 1, 18).add(4095, 12);
  objects.add(second);

  WireBits cpm = wireCpmHead(1, 1, 1);
  cpm.add(3 - 1, 3).add(2 - 1, 3);                           // segment 2 of 3
  cpm.add(10 - 1, 7).add(5, 3).add(100 - 1, 7).add(4, 3);    // rates
  cpm.add(0, 7).add(1, 1).addOpen(WireBits().add(0xEE, 8));  // an addition
  cpm.add(0, 1).add(3 - 1, 3);                               // three containers
  cpm.add(1 - 1, 4).addOpen(WireBits().add(0, 4).add(2700, 12).add(20 - 1, 7));
  cpm.add(3 - 1, 4).addOpen(WireBits().add(0x1234, 16));  // sensors: not read
  cpm.add(5 - 1, 4).addOpen(objects);
  return cpm;
}

}  // namespace datmo::samples
