// SPDX-License-Identifier: BSD-3-Clause
#include "stage_input.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace datmo::fuzz {

namespace {

constexpr std::size_t kMaxCount = std::numeric_limits<std::uint8_t>::max();
constexpr unsigned kByteBits = 8;

/// Reads numbers, least significant byte first, and texts.
class Reader {
 public:
  explicit Reader(std::string_view bytes) : bytes_(bytes) {}

  bool atEnd() const { return bytes_.empty(); }

  template <typename Number>
  Number number() {
    std::uint64_t value = 0;
    unsigned shift = 0;
    for (const char byte : text(sizeof(Number))) {
      value |= static_cast<std::uint64_t>(static_cast<std::uint8_t>(byte)) << shift;
      shift += kByteBits;
    }
    return static_cast<Number>(value);
  }

  std::string_view text(std::size_t size) {
    const std::string_view begin = bytes_.substr(0, size);
    bytes_.remove_prefix(begin.size());
    return begin;
  }

  std::string name() { return std::string(text(number<std::uint8_t>())); }

 private:
  std::string_view bytes_;
};

template <typename Number>
void append(std::string& bytes, Number number) {
  for (std::size_t i = 0; i < sizeof(Number); ++i) {
    bytes += static_cast<char>(static_cast<std::uint64_t>(number) >> (kByteBits * i));
  }
}

void appendName(std::string& bytes, const std::string& name) {
  const std::size_t size = std::min(name.size(), kMaxCount);
  append(bytes, static_cast<std::uint8_t>(size));
  bytes.append(name, 0, size);
}

}  // namespace

std::uint8_t doorIn(StageInput& input, const Door& door) {
  auto found = std::find(input.doors.begin(), input.doors.end(), door);
  if (found == input.doors.end() && input.doors.size() < kMaxCount) {
    found = input.doors.insert(found, door);
  }
  return static_cast<std::uint8_t>(found - input.doors.begin());
}

StageInput decodeStageInput(std::string_view bytes) {
  Reader reader(bytes);
  StageInput input;
  input.graph = reader.number<std::uint8_t>();
  input.doors.resize(reader.number<std::uint8_t>());
  for (Door& door : input.doors) {
    door.topic = reader.name();
    door.data_type = reader.name();
  }
  while (!input.doors.empty() && !reader.atEnd()) {
    Record record;
    record.door = reader.number<std::uint8_t>();
    record.wait = reader.number<std::uint16_t>();
    const std::string_view content = reader.text(reader.number<std::uint32_t>());
    record.bytes.assign(content.begin(), content.end());
    input.records.push_back(std::move(record));
  }
  return input;
}

std::string encode(const StageInput& input) {
  std::string bytes;
  append(bytes, input.graph);
  const std::size_t doors = std::min(input.doors.size(), kMaxCount);
  append(bytes, static_cast<std::uint8_t>(doors));
  for (std::size_t i = 0; i < doors; ++i) {
    appendName(bytes, input.doors[i].topic);
    appendName(bytes, input.doors[i].data_type);
  }
  for (const Record& record : input.records) {
    append(bytes, record.door);
    append(bytes, record.wait);
    append(bytes, static_cast<std::uint32_t>(record.bytes.size()));
    bytes.append(record.bytes.begin(), record.bytes.end());
  }
  return bytes;
}

}  // namespace datmo::fuzz
