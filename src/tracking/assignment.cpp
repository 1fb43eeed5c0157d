#include "datmo_fusion/tracking/assignment.h"

#include <stdexcept>
#include <string>
#include <utility>

namespace datmo {

namespace {

constexpr int kNone = -1;

/// One row after the other gets its place by the shortest path of reassignments.
class Solver {
 public:
  Solver(const CostMatrix& cost, const Eigen::VectorXd& unassigned_cost)
      : cost_(cost),
        unassigned_cost_(unassigned_cost),
        rows_(static_cast<int>(cost.rows())),
        columns_(static_cast<int>(cost.cols())),
        row_price_(Eigen::VectorXd::Zero(rows_)),
        column_price_(Eigen::VectorXd::Zero(columns_)),
        column_of_row_(size(rows_), kUnassigned),
        row_of_column_(size(columns_), kNone) {}

  Assignment solve() {
    for (int row = 0; row < rows_; ++row) {
      augment(row);
    }
    Assignment result{column_of_row_, 0.0};
    for (int row = 0; row < rows_; ++row) {
      const int column = column_of_row_[size(row)];
      result.cost += column == kUnassigned ? unassigned_cost_[row] : cost_(row, column);
    }
    return result;
  }

 private:
  static std::size_t size(int number) { return static_cast<std::size_t>(number); }

  void augment(int root) {
    startSearch();
    double distance = 0.0;
    int row = root;
    while (true) {
      reachFrom(row, distance);
      const int nearest = nearestColumn();
      if (nearest == kNone || distance_[nearest] > distance_to_none_) {
        updatePrices(root, distance_to_none_);
        freeUp(last_row_, root);
        return;
      }
      distance = distance_[nearest];
      if (row_of_column_[size(nearest)] == kNone) {
        updatePrices(root, distance);
        take(nearest, root);
        return;
      }
      scanned_[size(nearest)] = true;
      row = row_of_column_[size(nearest)];
    }
  }

  void startSearch() {
    distance_.setConstant(columns_, kForbidden);
    reached_from_.assign(size(columns_), kNone);
    scanned_.assign(size(columns_), false);
    distance_to_none_ = kForbidden;
    last_row_ = kNone;
  }

  /// Shortens the paths to all columns, and to staying unassigned, by those over this row.
  void reachFrom(int row, double distance) {
    const double offset = distance - row_price_[row];
    for (int column = 0; column < columns_; ++column) {
      const double candidate = offset + cost_(row, column) - column_price_[column];
      if (!scanned_[size(column)] && candidate < distance_[column]) {
        distance_[column] = candidate;
        reached_from_[size(column)] = row;
      }
    }
    if (offset + unassigned_cost_[row] < distance_to_none_) {
      distance_to_none_ = offset + unassigned_cost_[row];
      last_row_ = row;
    }
  }

  int nearestColumn() const {
    int nearest = kNone;
    for (int column = 0; column < columns_; ++column) {
      if (!scanned_[size(column)] && distance_[column] < kForbidden &&
          (nearest == kNone || distance_[column] < distance_[nearest])) {
        nearest = column;
      }
    }
    return nearest;
  }

  /// Keeps all reduced costs at zero or more, and those of the assigned pairs at zero.
  void updatePrices(int root, double length) {
    row_price_[root] += length;
    for (int column = 0; column < columns_; ++column) {
      if (scanned_[size(column)]) {
        const double slack = length - distance_[column];
        row_price_[row_of_column_[size(column)]] += slack;
        column_price_[column] -= slack;
      }
    }
  }

  /// Gives each column on the path to the row it was reached from, from the end back to the root.
  void take(int column, int root) {
    for (int row = kNone; row != root;) {
      row = reached_from_[size(column)];
      row_of_column_[size(column)] = row;
      std::swap(column, column_of_row_[size(row)]);
    }
  }

  /// The last row of the path stays unassigned, and its column goes on along the path.
  void freeUp(int row, int root) {
    const int given_up = column_of_row_[size(row)];
    column_of_row_[size(row)] = kUnassigned;
    if (row != root) {
      take(given_up, root);
    }
  }

  const CostMatrix& cost_;
  const Eigen::VectorXd& unassigned_cost_;
  int rows_;
  int columns_;
  Eigen::VectorXd row_price_;
  Eigen::VectorXd column_price_;
  std::vector<int> column_of_row_;
  std::vector<int> row_of_column_;

  // Of the search for the present row.
  Eigen::VectorXd distance_;
  std::vector<int> reached_from_;
  std::vector<bool> scanned_;
  double distance_to_none_ = kForbidden;
  int last_row_ = kNone;
};

}  // namespace

Assignment solveAssignment(const CostMatrix& cost, const Eigen::VectorXd& unassigned_cost) {
  if (cost.rows() != unassigned_cost.size()) {
    throw std::invalid_argument(
        "costs of staying unassigned: " + std::to_string(unassigned_cost.size()) +
        ", expected one for each row: " + std::to_string(cost.rows()));
  }
  return Solver(cost, unassigned_cost).solve();
}

}  // namespace datmo
