// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory_resource>
#include <vector>

#include "priced_assignment.h"

#include "datmo_fusion/assignment/assignment.h"

namespace datmo {

/// Finds the cheapest change that assigns another column to a row: the shortest path from the row
/// by reduced costs (Dijkstra), forward along pairs, backward along assigned pairs, and through the
/// void, where one row gives up its column and another one gets a column.
///
/// Jonker and Volgenant 1987; Crouse, On implementing 2D rectangular assignment algorithms, 2016.
/// Each row's private column for staying unassigned is never stored. Forbidden pairs, which in most
/// problems are nearly all, are not visited: the cost of a search depends on what it reaches.
class AugmentingPath {
 public:
  AugmentingPath(const AssignmentCosts& costs, std::pmr::memory_resource* memory);

  /// Assigns the best column to a row that has nothing yet, and opens the row.
  void add(int row, PricedAssignment& assignment);

  /// Assigns another column to an open row, by the costs given for it. Returns false, without any
  /// change, if there is no other column.
  bool replace(int row, const RowCost& row_cost, PricedAssignment& assignment);

  /// Returns the number of possible pairs, rows and columns visited so far.
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

  // Of the current search.
  std::pmr::vector<double> distance_;   ///< of each column; kForbidden: not reached
  std::pmr::vector<int> reached_from_;  ///< row, or kVoid
  std::pmr::vector<char> is_left_;      ///< by column: visited, the shortest path to it is known
  std::pmr::vector<int> reached_;       ///< columns that may be visited next
  std::pmr::vector<int> left_;          ///< visited columns
  double void_distance_ = kForbidden;
  int void_from_row_ = kUnassigned;     ///< that gave up its column, or
  int void_from_column_ = kUnassigned;  ///< that was free
  bool void_left_ = false;
  std::pmr::vector<int> waiting_rows_;  ///< without a column, reached through the void
};

/// Finds the best assignment, starting from an empty one, row by row. Returns false if the work
/// limit was reached: the remaining rows, in their order, then got the cheapest free column; the
/// assignment is valid, but neither it nor its prices are optimal.
bool assignAll(const AssignmentCosts& costs, std::int64_t max_work, AugmentingPath& path,
               PricedAssignment& assignment);

}  // namespace datmo
