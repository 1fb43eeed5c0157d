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

std::string systemError() {
  return errno == 0 ? "it is truncated" : std::generic_category().message(errno);
}

/// Opens an unnamed file; if the file system does not support that, a named one that is unlinked.
int openUnnamed(const std::string& folder) {
  constexpr mode_t kOwner = 0600;
  const int unnamed = ::open(folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, kOwner);
  if (unnamed >= 0) {
    return unnamed;
  }
  std::string name = folder + "/datmo_fusion_tiles_XXXXXX";  // mkostemp's pattern
  const int named = mkostemp(name.data(), O_CLOEXEC);
  if (named >= 0) {
    unlink(name.c_str());
  }
  return named;
}

/// Repeats `transfer(done)`, a pread or pwrite of what is left after `done` bytes, until all are
/// transferred. Returns false, with errno, if it ends before.
template <typename Transfer>
bool transferAll(std::size_t bytes, Transfer&& transfer) {
  for (std::size_t done = 0; done < bytes;) {
    errno = 0;
    const ssize_t part = transfer(done);
    if (part > 0) {
      done += static_cast<std::size_t>(part);
    } else if (part == 0 || errno != EINTR) {
      return false;
    }
  }
  return true;
}

}  // namespace

void TileFileOptions::visit(OptionVisitor& visitor) {
  visitor.text({"folder", "",
                "folder of the unnamed file for tiles beyond max_tiles; empty: they are forgotten"},
               folder, {});
  visitor.number({"max_size", "MiB",
                  "maximum size of this file: 70 to 80 for a kilometer of a street in cells of 0.2 "
                  "m that is seen 25 m to each side"},
                 max_size, {0.0, 1e7});
}

TileFile::~TileFile() {
  if (descriptor_ >= 0) {
    close(descriptor_);
  }
}

std::shared_ptr<const TileFile::Tile> TileFile::write(const void* tile) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (options_.folder.empty()) {
    error_ = "map/tile_file/folder is empty, so there is no file for them";
    return nullptr;
  }
  if (!open()) {
    error_ = "there is no file for them in map/tile_file/folder '" + options_.folder +
             "': " + systemError();
    return nullptr;
  }
  const std::uint64_t offset = free_.empty() ? size_ : free_.back();
  if (static_cast<double>(offset + tile_bytes_) > options_.max_size * kBytesPerMebibyte) {
    error_ = "their file has reached map/tile_file/max_size";
    return nullptr;
  }
  const bool is_written = transferAll(tile_bytes_, [&](std::size_t done) {
    return pwrite(descriptor_, static_cast<const char*>(tile) + done, tile_bytes_ - done,
                  static_cast<off_t>(offset + done));
  });
  if (!is_written) {
    error_ = "their file in '" + options_.folder + "' cannot grow: " + systemError();
    return nullptr;
  }
  if (free_.empty()) {
    size_ += tile_bytes_;
  } else {
    free_.pop_back();
  }
  return std::shared_ptr<const Tile>(new Tile(shared_from_this(), offset));
}

bool TileFile::read(std::uint64_t offset, void* data, std::size_t bytes) {
  const bool is_read = transferAll(bytes, [&](std::size_t done) {
    return pread(descriptor_, static_cast<char*>(data) + done, bytes - done,
                 static_cast<off_t>(offset + done));
  });
  if (!is_read) {
    const std::lock_guard<std::mutex> lock(mutex_);
    error_ = "their file in '" + options_.folder + "' cannot be read: " + systemError();
  }
  return is_read;
}

void TileFile::release(std::uint64_t offset) {
  const std::lock_guard<std::mutex> lock(mutex_);
  free_.push_back(offset);
}

std::string TileFile::error() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return error_;
}

bool TileFile::open() {
  if (descriptor_ < 0) {
    descriptor_ = openUnnamed(options_.folder);
  }
  return descriptor_ >= 0;
}

}  // namespace datmo
