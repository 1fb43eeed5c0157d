// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory_resource>
#include <vector>

#include "priced_assignment.h"

#include "datmo_fusion/assignment/assignment.h"

namespace datmo {

/// Finds the cheapest change that gives one row another column: the shortest path from the row by
/// reduced costs (Dijkstra), along pairs, back along assigned pairs, and through the void, where
/// one row gives its column up and another one comes to a column.
///
/// Jonker and Volgenant 1987; Crouse, On implementing 2D rectangular assignment algorithms, 2016.
/// The columns of staying unassigned, which every row has to itself, are never stored. Pairs that
/// are forbidden, in most problems nearly all, are not looked at: a search costs what it reaches.
class AugmentingPath {
 public:
  AugmentingPath(const AssignmentCosts& costs, std::pmr::memory_resource* memory);

  /// A row that has nothing yet gets the best column, and is open from then on.
  void add(int row, PricedAssignment& assignment);

  /// An open row gets another column than it has, by the costs given for it. False, and nothing
  /// changed: there is no other column.
  bool replace(int row, const RowCost& row_cost, PricedAssignment& assignment);

  /// Possible pairs, rows and columns that were looked at until now.
  std::int64_t work() const { return work_; }

 private:
  struct Node {
    enum class Kind : std::uint8_t { kColumn, kRow, kVoid };
    Kind kind = Kind::kVoid;
    int position = 0;  ///< in the list of reached columns, or of waiting rows
    double distance = kForbidden;
  };

  /// The ends of a path.
  struct Search {
    int root;
    RowCost root_cost;
    int target;  ///< column; kUnassigned: the void
  };

  bool run(const Search& search, PricedAssignment& assignment);
  void start();
  double find(const Search& search, const PricedAssignment& assignment);
  Node nearest(const PricedAssignment& assignment) const;
  bool comesFirst(int column, const Node& nearest, const PricedAssignment& assignment) const;
  int close(int position);
  bool isOpen(int column, const PricedAssignment& assignment) const;
  void reach(int column, double distance, int from);
  void reachVoid(double distance, int row, int column);
  void leaveRow(int row, const RowCost& cost, double distance, const PricedAssignment& assignment);
  void leaveColumn(int column, double distance, const PricedAssignment& assignment);
  void leaveVoid(const Search& search, const PricedAssignment& assignment);
  double throughVoid(int row, const PricedAssignment& assignment) const;
  double distanceOf(int row, const PricedAssignment& assignment) const;
  void updatePrices(const Search& search, double length, PricedAssignment& assignment) const;
  void updateAllPrices(const Search& search, double length, PricedAssignment& assignment) const;
  void apply(const Search& search, PricedAssignment& assignment) const;

  const AssignmentCosts& costs_;
  std::int64_t work_ = 0;

  // Of the present search.
  std::pmr::vector<double> distance_;   ///< of each column; kForbidden: not reached
  std::pmr::vector<int> reached_from_;  ///< row, or kVoid
  std::pmr::vector<char> is_left_;      ///< by column: the shortest path to it is known
  std::pmr::vector<int> reached_;       ///< columns that may be left next
  std::pmr::vector<int> left_;          ///< columns
  double void_distance_ = kForbidden;
  int void_from_row_ = kUnassigned;     ///< that gave its column up, or
  int void_from_column_ = kUnassigned;  ///< that was free
  bool void_left_ = false;
  std::pmr::vector<int> waiting_rows_;  ///< without column, reached through the void
};

/// The best assignment, from one that has nothing yet: one row after the other gets its column.
/// False: it took more work than allowed, and the rows that were left, in their order, got the
/// cheapest column that was free; the assignment is valid but not the best, and nor are its prices.
bool assignAll(const AssignmentCosts& costs, std::int64_t max_work, AugmentingPath& path,
               PricedAssignment& assignment);

}  // namespace datmo
