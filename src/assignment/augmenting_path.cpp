// SPDX-License-Identifier: BSD-3-Clause
#include "augmenting_path.h"

#include <algorithm>
#include <utility>

namespace datmo {

namespace {

/// Stands for the row from which a column was reached.
constexpr int kVoid = -2;

void giveCheapestFree(int row, const AssignmentCosts& costs, PricedAssignment& assignment) {
  int cheapest = kUnassigned;
  double min = costs.unassigned[row];
  for (int column = 0; column < costs.columns(); ++column) {
    if (assignment.row_of_column[column] == kUnassigned && costs.pairs(row, column) < min) {
      cheapest = column;
      min = costs.pairs(row, column);
    }
  }
  assignment.column_of_row[row] = cheapest;
  if (cheapest != kUnassigned) {
    assignment.row_of_column[cheapest] = row;
  }
}

}  // namespace

AugmentingPath::AugmentingPath(const AssignmentCosts& costs, std::pmr::memory_resource* memory)
    : costs_(costs),
      distance_(costs.columns(), kForbidden, memory),
      reached_from_(costs.columns(), kVoid, memory),
      is_left_(costs.columns(), 0, memory),
      reached_(memory),
      left_(memory),
      waiting_rows_(memory) {
  reached_.reserve(costs.columns());
  left_.reserve(costs.columns());
}

void AugmentingPath::add(int row, PricedAssignment& assignment) {
  assignment.open(row);
  run({row, costs_.row(row), kUnassigned}, assignment);
}

bool AugmentingPath::replace(int row, const RowCost& row_cost, PricedAssignment& assignment) {
  return run({row, row_cost, assignment.column_of_row[row]}, assignment);
}

bool AugmentingPath::run(const Search& search, PricedAssignment& assignment) {
  const double length = find(search, assignment);
  if (length == kForbidden) {
    return false;
  }
  if (void_left_) {
    work_ += static_cast<std::int64_t>(assignment.open_rows.size()) + costs_.columns();
  }
  updatePrices(search, length, assignment);
  apply(search, assignment);
  return true;
}

void AugmentingPath::start() {
  for (const std::pmr::vector<int>* columns : {&reached_, &left_}) {
    for (const int column : *columns) {
      distance_[column] = kForbidden;
      is_left_[column] = 0;
    }
  }
  reached_.clear();
  left_.clear();
  void_distance_ = kForbidden;
  void_left_ = false;
  waiting_rows_.clear();
}

/// Returns the length of the shortest path, or kForbidden.
double AugmentingPath::find(const Search& search, const PricedAssignment& assignment) {
  start();
  leaveRow(search.root, search.root_cost, 0.0, assignment);
  while (true) {
    work_ += static_cast<std::int64_t>(reached_.size() + waiting_rows_.size());
    const Node node = nearest(assignment);
    if (node.distance == kForbidden) {
      return kForbidden;
    }
    if (node.kind == Node::Kind::kVoid) {
      if (search.target == kUnassigned) {
        return node.distance;
      }
      leaveVoid(search, assignment);
    } else if (node.kind == Node::Kind::kRow) {
      const int row = waiting_rows_[node.position];
      waiting_rows_.erase(waiting_rows_.begin() + node.position);
      leaveRow(row, costs_.row(row), node.distance, assignment);
    } else {
      const int column = close(node.position);
      if (column == search.target) {
        return node.distance;
      }
      leaveColumn(column, node.distance, assignment);
    }
  }
}

/// The nearest open node. On a tie, columns come before the void, unless its path is through a free
/// column, and the void before rows.
AugmentingPath::Node AugmentingPath::nearest(const PricedAssignment& assignment) const {
  Node result;
  for (int position = 0; position < static_cast<int>(reached_.size()); ++position) {
    const int column = reached_[position];
    if (distance_[column] <= result.distance && comesFirst(column, result, assignment)) {
      result = {Node::Kind::kColumn, position, distance_[column]};
    }
  }
  if (!void_left_ && (void_distance_ < result.distance ||
                      (void_distance_ == result.distance && void_from_column_ != kUnassigned))) {
    return {Node::Kind::kVoid, 0, void_distance_};
  }
  for (int position = 0; position < static_cast<int>(waiting_rows_.size()); ++position) {
    const double distance = throughVoid(waiting_rows_[position], assignment);
    if (distance < result.distance) {
      result = {Node::Kind::kRow, position, distance};
    }
  }
  return result;
}

/// Whether a column that is no farther than the nearest one so far is visited before it: of equally
/// near ones the free ones, which end most searches, then the earlier ones.
bool AugmentingPath::comesFirst(int column, const Node& nearest,
                                const PricedAssignment& assignment) const {
  if (distance_[column] < nearest.distance) {
    return true;
  }
  if (nearest.kind != Node::Kind::kColumn) {
    return false;
  }
  const int other = reached_[nearest.position];
  const bool free = assignment.row_of_column[column] == kUnassigned;
  const bool other_free = assignment.row_of_column[other] == kUnassigned;
  return free == other_free ? column < other : free;
}

/// Removes a column from the reached ones.
int AugmentingPath::close(int position) {
  const int column = reached_[position];
  reached_[position] = reached_.back();
  reached_.pop_back();
  left_.push_back(column);
  is_left_[column] = 1;
  return column;
}

bool AugmentingPath::isOpen(int column, const PricedAssignment& assignment) const {
  return is_left_[column] == 0 && assignment.row_of_column[column] != kFixed;
}

void AugmentingPath::reach(int column, double distance, int from) {
  if (distance_[column] == kForbidden) {
    reached_.push_back(column);
  }
  distance_[column] = distance;
  reached_from_[column] = from;
}

/// Shortens the paths to all open columns and to the void by those through this row.
void AugmentingPath::leaveRow(int row, const RowCost& cost, double distance,
                              const PricedAssignment& assignment) {
  const Possible columns = costs_.possible(row);
  work_ += columns.size();
  const double offset = distance - assignment.row_price[row];
  for (const int column : columns) {
    const double candidate = offset + cost.columns[column] - assignment.column_price[column];
    if (candidate < distance_[column] && isOpen(column, assignment)) {
      reach(column, candidate, row);
    }
  }
  if (!void_left_ && offset + cost.unassigned < void_distance_) {
    reachVoid(offset + cost.unassigned, row, kUnassigned);
  }
}

/// Continues to the row that has the column, or, if it is free, to the void.
void AugmentingPath::leaveColumn(int column, double distance, const PricedAssignment& assignment) {
  const int row = assignment.row_of_column[column];
  if (row != kUnassigned) {
    leaveRow(row, costs_.row(row), distance, assignment);
  } else if (!void_left_ && distance + assignment.column_price[column] <= void_distance_) {
    reachVoid(distance + assignment.column_price[column], kUnassigned, column);
  }
}

void AugmentingPath::reachVoid(double distance, int row, int column) {
  void_distance_ = distance;
  void_from_row_ = row;
  void_from_column_ = column;
}

/// Columns may become free, and rows without a column may get one.
void AugmentingPath::leaveVoid(const Search& search, const PricedAssignment& assignment) {
  void_left_ = true;
  work_ += static_cast<std::int64_t>(assignment.open_rows.size()) + costs_.columns();
  for (int column = 0; column < costs_.columns(); ++column) {
    const double candidate = void_distance_ - assignment.column_price[column];
    if (assignment.row_of_column[column] != kUnassigned && candidate < distance_[column] &&
        isOpen(column, assignment)) {
      reach(column, candidate, kVoid);
    }
  }
  for (const int row : assignment.open_rows) {
    if (row != search.root && assignment.column_of_row[row] == kUnassigned) {
      waiting_rows_.push_back(row);
    }
  }
}

double AugmentingPath::throughVoid(int row, const PricedAssignment& assignment) const {
  return void_distance_ + assignment.row_price[row] - costs_.unassigned[row];
}

double AugmentingPath::distanceOf(int row, const PricedAssignment& assignment) const {
  const int column = assignment.column_of_row[row];
  return column == kUnassigned ? throughVoid(row, assignment) : distance_[column];
}

/// Visited nodes are no farther than the end of the path; the void keeps its price of 0. If the
/// path does not lead through the void, nothing else changes.
void AugmentingPath::updatePrices(const Search& search, double length,
                                  PricedAssignment& assignment) const {
  if (void_left_) {
    updateAllPrices(search, length, assignment);
    return;
  }
  // A new root has no price yet: its path may have a negative length.
  assignment.row_price[search.root] += length;
  for (const int column : left_) {
    const double change = length - std::min(distance_[column], length);
    const int row = assignment.row_of_column[column];
    if (row != kUnassigned && row != search.root) {
      assignment.row_price[row] += change;
    }
    assignment.column_price[column] -= change;
  }
}

void AugmentingPath::updateAllPrices(const Search& search, double length,
                                     PricedAssignment& assignment) const {
  const double void_distance = std::min(void_distance_, length);
  for (const int row : assignment.open_rows) {
    const double distance =
        row == search.root ? 0.0 : std::min(distanceOf(row, assignment), length);
    assignment.row_price[row] += void_distance - distance;
  }
  for (int column = 0; column < costs_.columns(); ++column) {
    if (assignment.row_of_column[column] != kFixed) {
      assignment.column_price[column] -= void_distance - std::min(distance_[column], length);
    }
  }
}

/// Applies the changes along the path, from its end back to the root.
void AugmentingPath::apply(const Search& search, PricedAssignment& assignment) const {
  int column = search.target;
  int row = kUnassigned;
  while (row != search.root) {
    if (column != kUnassigned && reached_from_[column] == kVoid) {
      assignment.row_of_column[column] = kUnassigned;
      column = kUnassigned;
    }
    if (column == kUnassigned) {
      column = void_from_column_;
    }
    if (column == kUnassigned) {
      row = void_from_row_;
    } else {
      row = reached_from_[column];
      assignment.row_of_column[column] = row;
    }
    std::swap(column, assignment.column_of_row[row]);
  }
}

bool assignAll(const AssignmentCosts& costs, std::int64_t max_work, AugmentingPath& path,
               PricedAssignment& assignment) {
  int row = 0;
  for (; row < costs.rows() && path.work() <= max_work; ++row) {
    path.add(row, assignment);
  }
  const bool all = row == costs.rows();
  for (; row < costs.rows(); ++row) {
    giveCheapestFree(row, costs, assignment);
  }
  return all;
}

}  // namespace datmo
