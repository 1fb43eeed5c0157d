// SPDX-License-Identifier: BSD-3-Clause
#include "message_record.h"

#include <cstdint>
#include <cstring>
#include <exception>
#include <string>

#include "bag_header.h"

#include <rosbag/bag.h>
#include <rosbag/buffer.h>
#include <rosbag/structures.h>

#include "datmo_fusion/ros/stage/input_error.h"

namespace datmo {

namespace {

// Where a message lies, rosbag keeps private. An explicit instantiation may name private members
// ([temp.spec]): the compiler checks that they exist and have these types.
template <typename Tag, typename Tag::Member kMember>
struct Exposed {
  friend typename Tag::Member member(Tag) { return kMember; }
};

struct Entry {
  using Member = const rosbag::IndexEntry rosbag::MessageInstance::*;
  friend Member member(Entry);
};
struct Source {
  using Member = const rosbag::Bag* rosbag::MessageInstance::*;
  friend Member member(Source);
};
struct Decompression {
  using Member = void (rosbag::Bag::*)(std::uint64_t) const;
  friend Member member(Decompression);
};
struct Chunk {
  using Member = rosbag::Buffer* rosbag::Bag::*;
  friend Member member(Chunk);
};
template struct Exposed<Entry, &rosbag::MessageInstance::index_entry_>;
template struct Exposed<Source, &rosbag::MessageInstance::bag_>;
template struct Exposed<Decompression, &rosbag::Bag::decompressChunk>;
template struct Exposed<Chunk, &rosbag::Bag::current_buffer_>;

constexpr std::uint8_t kMessageOp = 2;  ///< in the header of a message's record

using Length = std::uint32_t;

/// The number at a byte of a chunk; the caller knows that it is inside.
Length lengthAt(const std::uint8_t* bytes, std::uint64_t at) {
  Length length = 0;
  std::memcpy(&length, bytes + at, sizeof(length));
  return length;
}

/// Whether a whole record of a message begins at a byte of a chunk of `size` bytes.
bool isMessage(const std::uint8_t* bytes, std::uint64_t size, std::uint64_t at) {
  const std::uint64_t header = at + sizeof(Length);
  if (header > size) {
    return false;
  }
  const std::uint64_t header_end = header + lengthAt(bytes, at);
  const std::uint64_t data = header_end + sizeof(Length);
  if (data > size || data + lengthAt(bytes, header_end) > size) {
    return false;
  }
  const BagHeader fields(std::string(bytes + header, bytes + header_end));
  return fields.hasWholeFields() && fields.number<std::uint8_t>("op") == kMessageOp;
}

}  // namespace

void checkRecord(const rosbag::MessageInstance& message) {
  const rosbag::IndexEntry& entry = message.*member(Entry());
  const rosbag::Bag& bag = *(message.*member(Source()));
  std::string fault;
  try {
    (bag.*member(Decompression()))(entry.chunk_pos);
    rosbag::Buffer* chunk = bag.*member(Chunk());
    if (isMessage(chunk->getData(), chunk->getSize(), entry.offset)) {
      return;
    }
    fault = "byte " + std::to_string(entry.offset) + " of its chunk, which has " +
            std::to_string(chunk->getSize());
  } catch (const std::exception& error) {
    fault = error.what();
  }
  throw InputError("undecodable_message",
                   message.getTopic() + " at " + std::to_string(message.getTime().toSec()) +
                       " s: expected a record of a message where the bag's index says (" + fault +
                       "); skips it");
}

}  // namespace datmo
