// SPDX-License-Identifier: BSD-3-Clause
#include "bag_index.h"

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace datmo {

namespace {

const std::string kVersion = "#ROSBAG V2.0\n";

using Length = std::uint32_t;

constexpr std::uint64_t kCountSize = 8;   ///< bytes, of a connection's number of messages
constexpr std::uint64_t kIndexSize = 12;  ///< bytes, of a message's entry in an index
constexpr Length kMaxHeader = 1U << 24U;  ///< bytes; the longest ones hold a message's definition
constexpr Length kMaxChunk = 1U << 31U;   ///< bytes; rosbag allocates 4 GiB for more

/// Header and place of a record of the file.
struct Record {
  std::string header;
  std::uint64_t data = 0;  ///< byte at which its data begins
  Length data_size = 0;

  /// A number in the header; nothing if it is missing.
  template <typename Number>
  std::optional<Number> field(const std::string& name) const {
    // Fields are a length, a name, `=` and a value.
    for (std::size_t at = 0; at + sizeof(Length) <= header.size();) {
      Length length = 0;
      std::memcpy(&length, header.data() + at, sizeof(length));
      at += sizeof(length);
      if (length > header.size() - at) {
        return {};
      }
      if (header.compare(at, name.size() + 1, name + "=") == 0 &&
          length == name.size() + 1 + sizeof(Number)) {
        Number number = 0;
        std::memcpy(&number, header.data() + at + name.size() + 1, sizeof(number));
        return number;
      }
      at += length;
    }
    return {};
  }
};

class File {
 public:
  explicit File(const std::string& name)
      : stream_(name, std::ios::binary), size_(std::filesystem::file_size(name)) {}

  bool hasVersion() {
    std::string version(kVersion.size(), '\0');
    return read(0, version.data(), version.size()) && version == kVersion;
  }

  /// The record that begins at a byte; nothing if its header does not end within the file.
  std::optional<Record> record(std::uint64_t at) {
    Length length = 0;
    Record found;
    if (!read(at, &length, sizeof(length)) || length > kMaxHeader) {
      return {};
    }
    found.header.resize(length);
    found.data = at + sizeof(length) + length + sizeof(length);
    if (!read(at + sizeof(length), found.header.data(), length) ||
        !read(found.data - sizeof(length), &found.data_size, sizeof(length))) {
      return {};
    }
    return found;
  }

  /// Whether these bytes are within the file.
  bool holds(std::uint64_t at, std::uint64_t bytes) const {
    return at <= size_ && bytes <= size_ - at;
  }

  /// Whether these bytes are within the file and were read to `into`.
  bool read(std::uint64_t at, void* into, std::size_t bytes) {
    return holds(at, bytes) && stream_.seekg(static_cast<std::streamoff>(at)) &&
           stream_.read(static_cast<char*>(into), static_cast<std::streamsize>(bytes));
  }

 private:
  std::ifstream stream_;
  std::uint64_t size_;
};

/// Where a chunk is, and how many index records follow it.
struct ChunkPlace {
  std::uint64_t at = 0;
  std::size_t indexes = 0;
};

/// The chunk that a record describes; nothing if it does not.
std::optional<ChunkPlace> placeOf(const Record& info, std::uint32_t connections, File& file) {
  const auto at = info.field<std::uint64_t>("chunk_pos");
  if (!at || !file.holds(info.data, connections * kCountSize)) {
    return {};
  }
  std::set<std::uint32_t> numbers;  // one that is repeated has one index
  for (std::uint64_t i = 0; i < connections; ++i) {
    std::uint32_t number = 0;
    file.read(info.data + i * kCountSize, &number, sizeof(number));
    numbers.insert(number);
  }
  return ChunkPlace{*at, numbers.size()};
}

/// Whether the records of a chunk and its indexes are possible.
bool isPossible(const ChunkPlace& place, File& file) {
  const std::optional<Record> chunk = file.record(place.at);
  if (!chunk || !file.holds(chunk->data, chunk->data_size) ||
      chunk->field<std::uint32_t>("size").value_or(0) > kMaxChunk) {
    return false;
  }
  std::uint64_t at = chunk->data + chunk->data_size;
  for (std::size_t i = 0; i < place.indexes; ++i) {
    const std::optional<Record> index = file.record(at);
    if (!index) {
      return false;
    }
    at = index->data + index->field<std::uint32_t>("count").value_or(0) * kIndexSize;
  }
  return true;
}

}  // namespace

bool hasPossibleIndex(const std::string& file_name) {
  File file(file_name);
  if (!file.hasVersion()) {
    return true;
  }
  const std::optional<Record> head = file.record(kVersion.size());
  if (!head) {
    return false;
  }
  std::uint64_t at = head->field<std::uint64_t>("index_pos").value_or(0);
  if (at == 0) {
    return true;  // still being written
  }
  const auto connections = head->field<std::uint32_t>("conn_count").value_or(0);
  for (std::uint32_t i = 0; i < connections; ++i) {
    const std::optional<Record> connection = file.record(at);
    if (!connection || connection->data_size > kMaxHeader ||
        !file.holds(connection->data, connection->data_size)) {
      return false;
    }
    at = connection->data + connection->data_size;
  }
  const auto chunks = head->field<std::uint32_t>("chunk_count").value_or(0);
  std::vector<ChunkPlace> places;
  for (std::uint32_t i = 0; i < chunks; ++i) {
    const std::optional<Record> info = file.record(at);
    const auto count = info ? info->field<std::uint32_t>("count").value_or(0) : 0;
    const std::optional<ChunkPlace> place = info ? placeOf(*info, count, file) : std::nullopt;
    if (!place) {
      return false;
    }
    places.push_back(*place);
    at = info->data + count * kCountSize;
  }
  for (const ChunkPlace& place : places) {
    if (!isPossible(place, file)) {
      return false;
    }
  }
  return true;
}

}  // namespace datmo
