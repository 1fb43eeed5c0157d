// SPDX-License-Identifier: BSD-3-Clause
// SPATEM and MAPEM with all optional fields, including those that are skipped.
#pragma once

#include "fusion/signal_messages.h"

namespace datmo::samples {

/// An addition to a region, which a reader skips.
inline WireBits regionalAddition(const WireBits& content) {
  return WireBits().add(0, 2).add(3, 8).addOpen(content);
}

inline WireBits connectionAssist() {
  return WireBits()
      .add(0, 1)
      .add(0b11110, 5)  // all but the region
      .add(4, 8)
      .add(100, 14)
      .add(200, 14)
      .add(1, 1)
      .add(0, 1);
}

/// With an addition from a later version.
inline WireBits speedAdvice() {
  return WireBits()
      .add(1, 1)  // extended
      .add(0b11110, 5)
      .add(0, 1)
      .add(1, 2)
      .add(139, 9)
      .add(4, 3)
      .add(50, 14)
      .add(2, 8)
      .add(0, 1)  // one addition,
      .add(0, 6)
      .add(1, 1)  // which is there
      .addOpen(WireBits().add(0xFF, 8));
}

/// The events of a movement with all optional fields.
inline WireBits eventsWithAll(const WireBits& regional) {
  const WireBits assist = connectionAssist();
  return WireBits()
      .add(0, 4)
      .add(0, 1)
      .add(0b011, 3)  // speeds and region
      .add(3, 4)
      .add(0, 4)
      .add(speedAdvice())
      .add(regional)
      .add(0, 4)
      .add(assist)
      .add(regional)
      .add(0, 4)
      .add(assist)
      .add(regional);
}

/// A SPATEM with all optional fields besides those that are read.
inline WireBits spatemWithAll() {
  const WireBits regional = regionalAddition(WireBits().add(0xABC, 12));
  return signalHeader(4)
      .add(0, 1)
      .add(0b010, 3)  // a name alone
      .add(2 - 1, 6)
      .add('S', 7)
      .add('1', 7)
      .add(0, 5)
      .add(1, 1)         // extended
      .add(0b100111, 6)  // name, lanes, assist, region
      .add(0, 6)
      .add('X', 7)
      .add(0, 1)
      .add(77, 16)
      .add(0, 7)
      .add(0, 16)
      .add(1, 4)  // two lanes that are open
      .add(5, 8)
      .add(6, 8)
      .add(0, 8)
      .add(0, 1)
      .add(0b111, 3)
      .add(0, 6)
      .add('M', 7)
      .add(9, 8)
      .add(eventsWithAll(regional))
      .add(0, 1)  // of the intersection: one addition
      .add(0, 6)
      .add(1, 1)
      .addOpen(WireBits().add(0x12, 8));
}

/// The attributes of a node, with a segment's name from a later version.
inline WireBits nodeAttributes(const WireBits& regional, const WireBits& limits) {
  return WireBits()
      .add(0, 1)
      .add(0b1111111, 7)
      .add(0, 3)
      .add(0, 1)
      .add(1, 4)  // stop line
      .add(0, 3)
      .add(0, 1)
      .add(2, 6)
      .add(0, 3)
      .add(1, 1)  // a segment's name of a later version
      .add(0, 1)
      .add(3, 6)
      .add(2, 3)  // data: angle, merge angle, speed limits
      .add(0, 4)
      .add(150, 9)
      .add(4, 4)
      .add(180, 9)
      .add(5, 4)
      .add(limits)
      .add(512, 10)
      .add(512, 10)
      .add(regional);
}

/// A lane with all optional fields except connections.
inline WireBits laneWithAll(const WireBits& regional, const WireBits& limits) {
  return WireBits()
      .add(0b1111011, 7)  // all but connections
      .add(200, 8)
      .add(0, 6)
      .add('L', 7)
      .add(1, 4)
      .add(2, 4)
      .add(1, 1)  // attributes with a region
      .add(0b11, 2)
      .add(1 << 6, 10)
      .add(0, 1)
      .add(2, 3)  // for bicycles
      .add(0, 16)
      .add(3, 8)
      .addOpen(WireBits().add(1, 1))
      .add(0x800, 12)
      .add(0b00, 2)
      .add(0, 6)  // two nodes
      .add(0b01, 2)
      .add(6, 3)  // a position on the earth
      .add(57210000 + 1800000000, 32)
      .add(451910000 + 900000000, 31)
      .add(nodeAttributes(regional, limits))
      .add(0b00, 2)
      .add(4, 3)
      .add(1000 + 8192, 14)
      .add(0 + 8192, 14)
      .add(1, 3)  // two overlays
      .add(1, 8)
      .add(2, 8)
      .add(regional);
}

/// A MAPEM with all optional fields besides those that are read.
inline WireBits mapemWithAll() {
  const WireBits regional = regionalAddition(WireBits().add(0x5, 4));
  const WireBits limits = WireBits().add(0, 4).add(0, 1).add(5, 4).add(694, 13);
  return signalHeader(5)
      .add(0, 1)
      .add(0b11110000, 8)
      .add(4, 20)
      .add(1, 7)
      .add(0, 1)  // layer type
      .add(3, 3)
      .add(50, 7)
      .add(0, 5)
      .add(0, 1)
      .add(0b10111, 5)  // name, limits, preemption, region
      .add(0, 6)
      .add('N', 7)
      .add(0, 1)
      .add(3456, 16)
      .add(0, 7)
      .add(0, 1)
      .add(0b11, 2)  // elevation, region
      .add(451900000 + 900000000, 31)
      .add(57200000 + 1800000000, 32)
      .add(2120 + 4096, 16)
      .add(regional)
      .add(limits)
      .add(0, 8)
      .add(0, 1)
      .add(laneWithAll(regional, limits))
      .add(0, 5)  // preemption
      .add(0, 1)
      .add(3, 8)
      .addOpen(WireBits().add(1, 1))
      .add(regional);
}

}  // namespace datmo::samples
