// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace datmo::fuzz {

/// A topic of a graph of stages, and the type of its messages.
struct Door {
  std::string topic;
  std::string data_type;

  bool operator==(const Door& other) const {
    return topic == other.topic && data_type == other.data_type;
  }
};

/// A message at one of the doors.
struct Record {
  std::uint8_t door = 0;   ///< index; modulo their number
  std::uint16_t wait = 0;  ///< ms, since the record before
  std::vector<std::uint8_t> bytes;
};

/// A sequence of serialized messages for one of the campaign's graphs.
struct StageInput {
  std::uint8_t graph = 0;  ///< index; modulo their number
  std::vector<Door> doors;
  std::vector<Record> records;

  /// The door of a record; there must be doors.
  const Door& doorOf(const Record& record) const { return doors[record.door % doors.size()]; }
};

/// Returns the index of a door, which is added if it is new; any other one if there are too many.
std::uint8_t doorIn(StageInput& input, const Door& door);

/// Reads what encode() has written. Never fails: bytes that are missing are zero, and a record that
/// ends early is shorter. Without doors, there are no records.
StageInput decodeStageInput(std::string_view bytes);

std::string encode(const StageInput& input);

}  // namespace datmo::fuzz
