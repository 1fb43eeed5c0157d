// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/grid/tile_file.h"

#include <cerrno>
#include <cstdlib>
#include <system_error>

#include <fcntl.h>
#include <unistd.h>

namespace datmo {

namespace {

constexpr double kBytesPerMebibyte = 1024.0 * 1024.0;

std::string systemError() { return std::generic_category().message(errno); }

/// All bytes, as far as the system takes them in parts; false with errno if it takes no more.
bool writeAll(int descriptor, const char* data, std::size_t bytes, std::uint64_t offset) {
  while (bytes > 0) {
    const ssize_t written = pwrite(descriptor, data, bytes, static_cast<off_t>(offset));
    if (written < 0 && errno == EINTR) {
      continue;
    }
    if (written <= 0) {
      return false;
    }
    const auto part = static_cast<std::size_t>(written);
    data += part;
    bytes -= part;
    offset += part;
  }
  return true;
}

}  // namespace

void TileFileOptions::visit(OptionVisitor& visitor) {
  visitor.text(
      {"folder", "",
       "where tiles go that are more than max_tiles, in a file without a name; empty: they "
       "are forgotten"},
      folder, {});
  visitor.number({"max_size", "MiB",
                  "of this file: 70 to 80 for a kilometer of a street in cells of 0.2 m that is "
                  "seen 25 m to each side"},
                 max_size, {0.0, 1e7});
}

TileFile::~TileFile() {
  if (descriptor_ >= 0) {
    close(descriptor_);
  }
}

std::optional<std::uint64_t> TileFile::append(const void* data, std::size_t bytes) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (options_.folder.empty()) {
    return fail("tile_file/folder is empty");
  }
  if (static_cast<double>(size_ + bytes) > options_.max_size * kBytesPerMebibyte) {
    return fail("the file of tiles has tile_file/max_size");
  }
  if (!open()) {
    return fail("no file of tiles in '" + options_.folder + "': " + systemError());
  }
  if (!writeAll(descriptor_, static_cast<const char*>(data), bytes, size_)) {
    return fail("the file of tiles in '" + options_.folder + "' cannot grow: " + systemError());
  }
  const std::uint64_t offset = size_;
  size_ += bytes;
  return offset;
}

bool TileFile::read(std::uint64_t offset, void* data, std::size_t bytes) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  auto* next = static_cast<char*>(data);
  while (bytes > 0) {
    const ssize_t part = pread(descriptor_, next, bytes, static_cast<off_t>(offset));
    if (part < 0 && errno == EINTR) {
      continue;
    }
    if (part <= 0) {
      return false;
    }
    next += part;
    offset += static_cast<std::uint64_t>(part);
    bytes -= static_cast<std::size_t>(part);
  }
  return true;
}

std::string TileFile::error() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return error_;
}

bool TileFile::open() {
  if (descriptor_ < 0) {
    std::string name = options_.folder + "/datmo_fusion_tiles_XXXXXX";  // mkostemp's pattern
    descriptor_ = mkostemp(name.data(), O_CLOEXEC);
    if (descriptor_ >= 0) {
      unlink(name.c_str());
    }
  }
  return descriptor_ >= 0;
}

std::nullopt_t TileFile::fail(const std::string& what) {
  error_ = what;
  return std::nullopt;
}

}  // namespace datmo
