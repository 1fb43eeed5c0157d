// SPDX-License-Identifier: BSD-3-Clause
#include "fuzzed_drive.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace datmo::fuzz {

namespace {

constexpr std::size_t kMaxCount = std::numeric_limits<std::uint8_t>::max();
constexpr unsigned kByteBits = 8;

using MessageSize = std::uint32_t;

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

std::uint8_t topicIndexIn(FuzzedDrive& drive, const TypedTopic& topic) {
  auto found = std::find(drive.topics.begin(), drive.topics.end(), topic);
  if (found == drive.topics.end() && drive.topics.size() < kMaxCount) {
    found = drive.topics.insert(found, topic);
  }
  return static_cast<std::uint8_t>(found - drive.topics.begin());
}

FuzzedDrive decodeDrive(std::string_view bytes) {
  Reader reader(bytes);
  FuzzedDrive drive;
  drive.graph = reader.number<std::uint8_t>();
  drive.topics.resize(reader.number<std::uint8_t>());
  for (TypedTopic& topic : drive.topics) {
    topic.name = reader.name();
    topic.data_type = reader.name();
  }
  while (!drive.topics.empty() && !reader.atEnd()) {
    TimedMessage message;
    message.topic = reader.number<std::uint8_t>();
    message.wait = reader.number<std::uint16_t>();
    const std::string_view content = reader.text(reader.number<MessageSize>());
    message.bytes.assign(content.begin(), content.end());
    drive.messages.push_back(std::move(message));
  }
  return drive;
}

std::string encode(const FuzzedDrive& drive) {
  std::string bytes;
  append(bytes, drive.graph);
  const std::size_t topics = std::min(drive.topics.size(), kMaxCount);
  append(bytes, static_cast<std::uint8_t>(topics));
  for (std::size_t i = 0; i < topics; ++i) {
    appendName(bytes, drive.topics[i].name);
    appendName(bytes, drive.topics[i].data_type);
  }
  for (const TimedMessage& message : drive.messages) {
    append(bytes, message.topic);
    append(bytes, message.wait);
    append(bytes, static_cast<MessageSize>(message.bytes.size()));
    bytes.append(message.bytes.begin(), message.bytes.end());
  }
  return bytes;
}

std::size_t encodedSize(const TimedMessage& message) {
  return sizeof(message.topic) + sizeof(message.wait) + sizeof(MessageSize) + message.bytes.size();
}

}  // namespace datmo::fuzz
