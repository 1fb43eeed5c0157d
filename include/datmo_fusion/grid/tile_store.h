// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <deque>
#include <map>
#include <utility>
#include <vector>

#include "datmo_fusion/grid/cell_index.h"
#include "datmo_fusion/grid/row_major.h"

namespace datmo {

/// Cells of the lattice outside of a rolling window, in square tiles, so that memory grows with the
/// area that was visited. Of more than so many tiles the first ones are forgotten, but for those
/// that are kept for good.
template <typename Cell>
class TileStore {
 public:
  /// `max_tiles`: 1 and more. `empty`: a cell that was never put.
  TileStore(int max_tiles, const Cell& empty)
      : max_tiles_(static_cast<std::size_t>(max_tiles)), empty_(empty) {}

  void put(CellIndex cell, const Cell& content) {
    const auto [tile, is_new] = tiles_.try_emplace(keyOf(cell));
    if (is_new) {
      tile->second.assign(rowMajorSize(kSide, kSide), empty_);
      order_.push_back(tile->first);
    }
    tile->second[slotOf(cell)] = content;
    if (order_.size() > max_tiles_) {
      tiles_.erase(order_.front());
      order_.pop_front();
      ++forgotten_;
    }
  }

  /// As put(), in a tile that is never forgotten, and does not count.
  void putPermanently(CellIndex cell, const Cell& content) {
    const auto [tile, is_new] = tiles_.try_emplace(keyOf(cell));
    if (is_new) {
      tile->second.assign(rowMajorSize(kSide, kSide), empty_);
    }
    tile->second[slotOf(cell)] = content;
  }

  /// Empty where nothing was put.
  const Cell& at(CellIndex cell) const {
    const auto tile = tiles_.find(keyOf(cell));
    return tile == tiles_.end() ? empty_ : tile->second[slotOf(cell)];
  }

  /// `visit(CellIndex, const Cell&)` for all cells of all tiles, in a fixed order.
  template <typename Visit>
  void forEach(Visit&& visit) const {
    for (const auto& [key, cells] : tiles_) {
      for (int row = 0; row < kSide; ++row) {
        for (int column = 0; column < kSide; ++column) {
          visit(CellIndex{key.first * kSide + column, key.second * kSide + row},
                cells[rowMajorIndex(column, row, kSide)]);
        }
      }
    }
  }

  std::size_t size() const { return tiles_.size(); }

  /// How many tiles there was no room for.
  std::size_t forgotten() const { return forgotten_; }

  static constexpr int kSide = 32;  ///< cells

  /// Column and row of a tile.
  using Key = std::pair<int, int>;

  /// Of the tile of a cell.
  static Key keyOf(CellIndex cell) { return {tileOf(cell.column), tileOf(cell.row)}; }

 private:
  static int tileOf(int index) { return index >= 0 ? index / kSide : -1 - (-1 - index) / kSide; }
  static std::size_t slotOf(CellIndex cell) {
    const Key key = keyOf(cell);
    return rowMajorIndex(cell.column - key.first * kSide, cell.row - key.second * kSide, kSide);
  }

  std::size_t max_tiles_;
  Cell empty_;
  std::map<Key, std::vector<Cell>> tiles_;
  std::deque<Key> order_;  ///< as they were made
  std::size_t forgotten_ = 0;
};

}  // namespace datmo
