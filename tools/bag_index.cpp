// SPDX-License-Identifier: BSD-3-Clause
#include "bag_index.h"

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "bag_fault.h"
#include "bag_header.h"

namespace datmo {

namespace {

using Length = std::uint32_t;

constexpr std::uint64_t kCountSize = 8;   ///< bytes, of a connection's number of messages
constexpr std::uint64_t kIndexSize = 12;  ///< bytes, of a message's entry in an index
constexpr Length kMaxHeader = 1U << 24U;  ///< bytes; the longest ones hold a message's definition
constexpr Length kMaxChunk = 1U << 31U;   ///< bytes; rosbag allocates 4 GiB for more

/// Header and position of a record of the file.
struct Record {
  BagHeader header;
  std::uint64_t data = 0;  ///< byte at which its data begins
  Length data_size = 0;

  /// A number in the header; 0 if it is missing.
  std::uint32_t count(const std::string& name) const {
    return header.number<std::uint32_t>(name).value_or(0);
  }
};

class File {
 public:
  explicit File(const std::string& name)
      : stream_(name, std::ios::binary), size_(std::filesystem::file_size(name)) {}

  /// The header whose length is at a byte; nothing if it is not whole, or ends after the file.
  std::optional<BagHeader> header(std::uint64_t at) {
    Length length = 0;
    if (!read(at, &length, sizeof(length)) || length > kMaxHeader) {
      return {};
    }
    std::string bytes(length, '\0');
    if (!read(at + sizeof(length), bytes.data(), length)) {
      return {};
    }
    BagHeader found(std::move(bytes));
    return found.hasWholeFields() ? std::make_optional(std::move(found)) : std::nullopt;
  }

  /// The record that begins at a byte; nothing as for its header.
  std::optional<Record> record(std::uint64_t at) {
    const std::optional<BagHeader> fields = header(at);
    if (!fields) {
      return {};
    }
    Record found{*fields, at + 2 * sizeof(Length) + fields->size()};
    if (!read(found.data - sizeof(Length), &found.data_size, sizeof(Length))) {
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
struct ChunkPosition {
  std::uint64_t offset = 0;  ///< in the file, bytes
  std::size_t indexes = 0;
};

/// The chunk that a record describes; nothing if it does not.
std::optional<ChunkPosition> positionOf(const Record& info, std::uint32_t connections, File& file) {
  const auto at = info.header.number<std::uint64_t>("chunk_pos");
  if (!at || !file.holds(info.data, connections * kCountSize)) {
    return {};
  }
  std::set<std::uint32_t> numbers;  // one that is repeated has one index
  for (std::uint64_t i = 0; i < connections; ++i) {
    std::uint32_t number = 0;
    file.read(info.data + i * kCountSize, &number, sizeof(number));
    numbers.insert(number);
  }
  return ChunkPosition{*at, numbers.size()};
}

/// Whether the records of a chunk and its indexes are possible.
bool isPossible(const ChunkPosition& position, File& file) {
  const std::optional<Record> chunk = file.record(position.offset);
  if (!chunk || !file.holds(chunk->data, chunk->data_size) || chunk->count("size") > kMaxChunk) {
    return false;
  }
  std::uint64_t at = chunk->data + chunk->data_size;
  for (std::size_t i = 0; i < position.indexes; ++i) {
    const std::optional<Record> index = file.record(at);
    if (!index) {
      return false;
    }
    at = index->data + index->count("count") * kIndexSize;
  }
  return true;
}

}  // namespace

bool hasPossibleIndex(const std::string& file_name) {
  File file(file_name);
  const std::optional<Record> head = file.record(kBagVersion.size());
  if (!head) {
    return false;
  }
  std::uint64_t at = head->header.number<std::uint64_t>("index_pos").value_or(0);
  if (at == 0) {
    return true;  // still being written
  }
  const auto connections = head->count("conn_count");
  for (std::uint32_t i = 0; i < connections; ++i) {
    const std::optional<Record> connection = file.record(at);
    // Its data is a header, too.
    if (!connection || !file.header(connection->data - sizeof(Length))) {
      return false;
    }
    at = connection->data + connection->data_size;
  }
  const auto chunks = head->count("chunk_count");
  std::vector<ChunkPosition> chunk_positions;
  for (std::uint32_t i = 0; i < chunks; ++i) {
    const std::optional<Record> info = file.record(at);
    const auto count = info ? info->count("count") : 0;
    const std::optional<ChunkPosition> position =
        info ? positionOf(*info, count, file) : std::nullopt;
    if (!position) {
      return false;
    }
    chunk_positions.push_back(*position);
    at = info->data + count * kCountSize;
  }
  for (const ChunkPosition& position : chunk_positions) {
    if (!isPossible(position, file)) {
      return false;
    }
  }
  return true;
}

}  // namespace datmo
