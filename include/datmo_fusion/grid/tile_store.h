// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "datmo_fusion/grid/cell_index.h"
#include "datmo_fusion/grid/grid_window.h"
#include "datmo_fusion/grid/row_major.h"
#include "datmo_fusion/grid/tile_file.h"

namespace datmo {

/// Cells of the lattice outside a rolling window, in square tiles, so that memory grows with the
/// visited area. Beyond a maximum number of tiles, the oldest ones are moved to a file and read
/// back when a cell is put into them; if the file has no room, they are dropped. Permanent tiles
/// stay in memory.
template <typename Cell>
class TileStore {
 public:
  // Eigen's small matrices are not trivially copyable, but consist of nothing but numbers.
  static_assert(std::is_standard_layout_v<Cell> && std::is_trivially_destructible_v<Cell>,
                "cells are written as they lie in memory");

  /// `max_tiles`: in memory, at least 1. `empty`: the value of a cell that was never put.
  TileStore(int max_tiles, const Cell& empty, const TileFileOptions& file)
      : max_tiles_(static_cast<std::size_t>(max_tiles)),
        empty_(empty),
        file_(TileFile::make(file, kCells * sizeof(Cell))) {}

  void put(CellIndex cell, const Cell& content) {
    const auto [tile, is_new] = tiles_.try_emplace(keyOf(cell));
    if (is_new) {
      tile->second = loadFromFile(tile->first);
      order_.push_back(tile->first);
    }
    tile->second[slotOf(cell)] = content;
    if (order_.size() > max_tiles_) {
      moveToFile(order_.front());
      order_.pop_front();
    }
  }

  /// Like put(), but the tile stays in memory and does not count toward `max_tiles`.
  void putPermanently(CellIndex cell, const Cell& content) {
    const auto [tile, is_new] = tiles_.try_emplace(keyOf(cell));
    if (is_new) {
      tile->second = loadFromFile(tile->first);
    }
    tile->second[slotOf(cell)] = content;
  }

  /// Returns the cell; empty if nothing was put there, or it cannot be read.
  Cell at(CellIndex cell) const {
    const Key key = keyOf(cell);
    const auto tile = tiles_.find(key);
    if (tile != tiles_.end()) {
      return tile->second[slotOf(cell)];
    }
    const auto filed = filed_.find(key);
    Cell content;
    const bool is_read = filed != filed_.end() &&
                         filed->second->read(slotOf(cell) * sizeof(Cell), &content, sizeof(Cell));
    return is_read ? content : empty_;
  }

  /// Calls `visit(CellIndex, const Cell&)` for all cells of all tiles, in a fixed order; tiles that
  /// cannot be read are skipped (see fileError()).
  template <typename Visit>
  void forEach(Visit&& visit) const {
    forEachOf([](const Key&) { return true; }, visit);
  }

  /// The same for all cells of the tiles that overlap a window.
  template <typename Visit>
  void forEachAround(const GridWindow& window, Visit&& visit) const {
    const Key first = keyOf(window.corner);
    const Key last =
        keyOf({window.corner.column + window.columns - 1, window.corner.row + window.rows - 1});
    const auto is_around = [&](const Key& key) {
      return key.first >= first.first && key.first <= last.first && key.second >= first.second &&
             key.second <= last.second;
    };
    forEachOf(is_around, visit);
  }

  /// Returns the number of tiles in memory and in the file.
  std::size_t size() const { return tiles_.size() + filed_.size(); }

  /// Returns the number of tiles that were dropped; fileError() tells why.
  std::size_t forgotten() const { return forgotten_; }
  std::string fileError() const { return file_->error(); }

  static constexpr int kSide = 32;  ///< cells

  /// Column and row of a tile.
  using Key = std::pair<int, int>;

  /// Returns the key of the tile that contains a cell.
  static Key keyOf(CellIndex cell) {
    const CellIndex tile = inCoarserLattice(cell, kSide);
    return {tile.column, tile.row};
  }

 private:
  using Tile = std::vector<Cell>;
  static constexpr std::size_t kCells = rowMajorSize(kSide, kSide);

  static std::size_t slotOf(CellIndex cell) {
    const Key key = keyOf(cell);
    return rowMajorIndex(cell.column - key.first * kSide, cell.row - key.second * kSide, kSide);
  }

  template <typename Wanted, typename Visit>
  void forEachOf(Wanted&& wanted, Visit& visit) const {
    std::set<Key> keys;
    for (const auto& [key, cells] : tiles_) {
      keys.insert(key);
    }
    for (const auto& [key, tile] : filed_) {
      keys.insert(key);
    }
    for (const Key& key : keys) {
      if (!wanted(key)) {
        continue;
      }
      const auto tile = tiles_.find(key);
      if (tile != tiles_.end()) {
        visitTile(key, tile->second, visit);
      } else if (const auto cells = readTile(key)) {
        visitTile(key, *cells, visit);
      }
    }
  }

  template <typename Visit>
  static void visitTile(const Key& key, const Tile& cells, Visit& visit) {
    for (int row = 0; row < kSide; ++row) {
      for (int column = 0; column < kSide; ++column) {
        visit(CellIndex{key.first * kSide + column, key.second * kSide + row},
              cells[rowMajorIndex(column, row, kSide)]);
      }
    }
  }

  std::optional<Tile> readTile(const Key& key) const {
    const auto filed = filed_.find(key);
    Tile cells(kCells, empty_);
    const bool is_read =
        filed != filed_.end() && filed->second->read(0, cells.data(), kCells * sizeof(Cell));
    return is_read ? std::make_optional(std::move(cells)) : std::nullopt;
  }

  /// Returns an empty tile if it is not there.
  Tile loadFromFile(const Key& key) {
    std::optional<Tile> cells = readTile(key);
    const bool was_filed = filed_.erase(key) > 0;
    forgotten_ += was_filed && !cells ? 1 : 0;
    return cells ? std::move(*cells) : Tile(kCells, empty_);
  }

  void moveToFile(const Key& key) {
    const auto tile = tiles_.find(key);
    if (auto filed = file_->write(tile->second.data())) {
      filed_[key] = std::move(filed);
    } else {
      ++forgotten_;
    }
    tiles_.erase(tile);
  }

  std::size_t max_tiles_;
  Cell empty_;
  std::map<Key, Tile> tiles_;
  std::deque<Key> order_;  ///< in the order of creation or return
  std::map<Key, std::shared_ptr<const TileFile::Tile>> filed_;  ///< tiles not in memory
  std::shared_ptr<TileFile> file_;                              ///< shared by all copies
  std::size_t forgotten_ = 0;
};

}  // namespace datmo
