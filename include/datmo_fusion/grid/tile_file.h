// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "datmo_fusion/common/options.h"

namespace datmo {

struct TileFileOptions {
  std::string folder = "/var/tmp";  ///< empty: no file
  double max_size = 1024.0;         ///< MiB

  void visit(OptionVisitor& visitor);
};

/// Stores tiles that do not fit in memory in an unnamed file, which disappears with the process. It
/// is created when the first tile is written. May be used by several threads, and by copies of a
/// map.
class TileFile : public std::enable_shared_from_this<TileFile> {
 public:
  /// One immutable tile in the file. Its space is freed with the last reference to it.
  class Tile {
   public:
    ~Tile() { file_->release(offset_); }
    Tile(const Tile&) = delete;
    Tile& operator=(const Tile&) = delete;

    /// Returns whether `bytes` from `begin` on could be read; if not, see TileFile::error().
    bool read(std::size_t begin, void* data, std::size_t bytes) const {
      return file_->read(offset_ + begin, data, bytes);
    }

   private:
    friend class TileFile;
    Tile(std::shared_ptr<TileFile> file, std::uint64_t offset)
        : file_(std::move(file)), offset_(offset) {}

    std::shared_ptr<TileFile> file_;
    std::uint64_t offset_;
  };

  /// `tile_bytes`: size of each tile.
  static std::shared_ptr<TileFile> make(const TileFileOptions& options, std::size_t tile_bytes) {
    return std::shared_ptr<TileFile>(new TileFile(options, tile_bytes));
  }
  ~TileFile();
  TileFile(const TileFile&) = delete;
  TileFile& operator=(const TileFile&) = delete;

  /// Writes a tile; returns null if there is no file or no room (see error()).
  std::shared_ptr<const Tile> write(const void* tile);

  /// Returns the last error, as a message for users; empty if there was none.
  std::string error() const;

 private:
  TileFile(TileFileOptions options, std::size_t tile_bytes)
      : options_(std::move(options)), tile_bytes_(tile_bytes) {}

  bool open();
  bool read(std::uint64_t offset, void* data, std::size_t bytes);
  void release(std::uint64_t offset);

  TileFileOptions options_;
  std::size_t tile_bytes_;
  mutable std::mutex mutex_;
  int descriptor_ = -1;
  std::uint64_t size_ = 0;
  std::vector<std::uint64_t> free_;  ///< offsets below size_
  std::string error_;
};

}  // namespace datmo
