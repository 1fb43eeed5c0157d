// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <mutex>
#include <optional>
#include <string>

#include "datmo_fusion/common/options.h"

namespace datmo {

struct TileFileOptions {
  std::string folder = "/var/tmp";  ///< empty: no file
  double max_size = 1024.0;         ///< MiB

  void visit(OptionVisitor& visitor);
};

/// What memory has no room for, in a file without a name, which is gone with the process, however
/// that ends. What was written stays as it is, so that copies of a map can share the file. It is
/// made when something is written first. May be used by several threads.
class TileFile {
 public:
  explicit TileFile(TileFileOptions options) : options_(std::move(options)) {}
  ~TileFile();
  TileFile(const TileFile&) = delete;
  TileFile& operator=(const TileFile&) = delete;

  /// Where in the file the bytes are now; none if there is no file or no room: see error().
  std::optional<std::uint64_t> append(const void* data, std::size_t bytes);

  /// Whether `bytes` from `offset` on could be read.
  bool read(std::uint64_t offset, void* data, std::size_t bytes) const;

  /// Why append() failed last, for users; empty if it never did.
  std::string error() const;

 private:
  bool open();
  std::nullopt_t fail(const std::string& what);

  TileFileOptions options_;
  mutable std::mutex mutex_;
  int descriptor_ = -1;
  std::uint64_t size_ = 0;
  std::string error_;
};

}  // namespace datmo
