// SPDX-License-Identifier: BSD-3-Clause
#include "stage_mutation.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <exception>
#include <iterator>
#include <limits>
#include <string>
#include <utility>

#include "message_kinds.h"

#include <ros/duration.h>

namespace datmo::fuzz {

namespace {

using campaign::MessageKind;
using campaign::messageKinds;

constexpr unsigned kMaxChanges = 4;      // to one input
constexpr std::size_t kMoreBytes = 256;  // by which a record may grow
constexpr double kMaxShift = 0.06;       // s, of a copy's stamps; the sensors' period

std::size_t below(std::size_t count, std::mt19937& random) { return random() % count; }

/// Calls `change` with a decoded message; its bytes remain if they are no message.
template <typename Change>
void changeMessage(const StageInput& input, Record& record, const Change& change) {
  const auto kind = messageKinds().find(input.doorOf(record).data_type);
  if (kind == messageKinds().end()) {
    return;
  }
  try {
    record.bytes = kind->second.encoded(change(kind->second, kind->second.decoded(record.bytes)));
  } catch (const std::exception&) {  // was made undecodable before
  }
}

void spoilFields(const StageInput& input, Record& record, std::mt19937& random) {
  changeMessage(input, record, [&](const MessageKind& kind, const AnyMessage& message) {
    return kind.mutated(message, random);
  });
}

/// Replaces a number somewhere in the bytes: of long lists, spoilFields() reaches only the
/// beginning.
template <typename Number>
void spoilNumber(Record& record, std::mt19937& random) {
  if (record.bytes.size() < sizeof(Number)) {
    return;
  }
  std::uint8_t* const at =
      record.bytes.data() + below(record.bytes.size() - sizeof(Number) + 1, random);
  Number number = 0;
  std::memcpy(&number, at, sizeof(Number));
  using Limits = std::numeric_limits<Number>;
  const std::array<Number, 10> numbers{Limits::quiet_NaN(),
                                       Limits::infinity(),
                                       -Limits::infinity(),
                                       Limits::max(),
                                       Limits::denorm_min(),
                                       Number(0),
                                       -number,
                                       number * Number(1e3),
                                       Number(-1),
                                       Number(1e9)};
  number = numbers[below(numbers.size(), random)];
  std::memcpy(at, &number, sizeof(Number));
}

/// Inserts a copy with later stamps, as if this sensor or stage sent at a higher rate.
void insertCopy(StageInput& input, std::size_t index, std::mt19937& random) {
  const ros::Duration shift(kMaxShift * static_cast<double>(below(100, random)) / 100.0);
  Record copy = input.records[index];
  changeMessage(input, copy, [&](const MessageKind& kind, const AnyMessage& message) {
    return kind.shifted(message, shift);
  });
  copy.wait = 0;
  spoilFields(input, copy, random);
  const auto next = static_cast<std::ptrdiff_t>(index + 1 + below(4, random));
  const auto size = static_cast<std::ptrdiff_t>(input.records.size());
  input.records.insert(input.records.begin() + std::min(next, size), std::move(copy));
}

void changeOrder(StageInput& input, std::size_t index, std::mt19937& random) {
  auto& records = input.records;
  const auto at = records.begin() + static_cast<std::ptrdiff_t>(index);
  switch (below(4, random)) {
    case 0:
      records.erase(at);
      break;
    case 1:
      std::swap(*at, records[below(records.size(), random)]);
      break;
    case 2:  // a sensor is silent from here on
      records.erase(
          std::remove_if(at, records.end(),
                         [door = at->door](const Record& record) { return record.door == door; }),
          records.end());
      break;
    default:
      records.insert(at, *at);  // the same message twice
      break;
  }
}

void changeWait(Record& record, std::mt19937& random) {
  constexpr std::array<std::uint16_t, 6> kWaits{0, 1, 30, 600, 1500, 60000};  // ms
  record.wait = kWaits[below(kWaits.size(), random)];
}

/// Passes the message to another topic of its type.
void changeDoor(const StageInput& input, Record& record, std::mt19937& random) {
  const std::string& type = input.doorOf(record).data_type;
  const std::size_t first = below(input.doors.size(), random);
  for (std::size_t i = 0; i < input.doors.size(); ++i) {
    const std::size_t door = (first + i) % input.doors.size();
    if (input.doors[door].data_type == type) {
      record.door = static_cast<std::uint8_t>(door);
      return;
    }
  }
}

void changeOnce(StageInput& input, std::mt19937& random, const MutateBytes& mutate_bytes) {
  if (input.records.empty()) {
    return;
  }
  const std::size_t index = below(input.records.size(), random);
  Record& record = input.records[index];
  switch (below(20, random)) {
    case 0:
    case 1:
      spoilNumber<float>(record, random);
      break;
    case 2:
      spoilNumber<double>(record, random);
      break;
    case 3:
    case 4:
      mutate_bytes(record.bytes, record.bytes.size() + kMoreBytes);
      break;
    case 5:
    case 6:
    case 7:
      insertCopy(input, index, random);
      break;
    case 8:
      changeOrder(input, index, random);
      break;
    case 9:
      changeWait(record, random);
      break;
    case 10:
      changeDoor(input, record, random);
      break;
    case 11:
      input.graph = static_cast<std::uint8_t>(random());
      break;
    default:
      spoilFields(input, record, random);
      break;
  }
}

}  // namespace

void mutate(StageInput& input, std::mt19937& random, const MutateBytes& mutate_bytes) {
  const std::size_t changes = 1 + below(kMaxChanges, random);
  for (std::size_t i = 0; i < changes; ++i) {
    changeOnce(input, random, mutate_bytes);
  }
}

StageInput crossed(const StageInput& begin, const StageInput& end, std::mt19937& random) {
  StageInput both{begin.graph, begin.doors, {}};
  // The same share of both, as the stamps of all seeds begin at the same time.
  const double share = std::uniform_real_distribution<double>()(random);
  const auto cut = [share](const std::vector<Record>& records) {
    return records.begin() +
           static_cast<std::ptrdiff_t>(share * static_cast<double>(records.size()));
  };
  both.records.assign(begin.records.begin(), cut(begin.records));
  std::for_each(cut(end.records), end.records.end(), [&](Record record) {
    record.door = doorIn(both, end.doorOf(record));
    both.records.push_back(std::move(record));
  });
  return both;
}

void shorten(StageInput& input, std::size_t max_size) {
  while (!input.records.empty() && encode(input).size() > max_size) {
    input.records.pop_back();
  }
}

}  // namespace datmo::fuzz
