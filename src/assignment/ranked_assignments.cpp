// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/assignment/ranked_assignments.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory_resource>
#include <numeric>
#include <utility>
#include <vector>

#include "augmenting_path.h"
#include "priced_assignment.h"
#include "ranked_part.h"

namespace datmo {

namespace {

/// Initial memory of a ranking, bytes: enough for the first few assignments of a tiny problem.
constexpr std::size_t kFirstMemory = 4096;

/// Parts with fewer rows are split faster than they are sorted.
constexpr int kRowsWorthOrdering = 8;

/// An entry of the queue: a part, or one split from a part and not searched yet.
struct Candidate {
  double min_cost = 0.0;  ///< of a part: exact, otherwise a lower bound
  int part = 0;
  int position =
      kNoIndex;  ///< of the row, in the order of `part`, that is to differ; kNoIndex: a part
  int number = 0;

  /// Order of the queue, which has the greatest element on top.
  bool operator<(const Candidate& other) const {
    return min_cost != other.min_cost ? min_cost > other.min_cost : number > other.number;
  }
};

struct RowBound {
  int row;
  double increase;
};

}  // namespace

class RankedAssignments::State {
 public:
  State(CostMatrix cost, Eigen::VectorXd unassigned_cost, std::int64_t max_work)
      : memory_(buffer_.data(), buffer_.size()),
        cost_(std::move(cost)),
        unassigned_cost_(std::move(unassigned_cost)),
        rows_of_columns_(costs_, &memory_),
        max_work_(max_work),
        path_(costs_, &memory_),
        present_(costs_.rows(), costs_.columns(), &memory_),
        allowed_(costs_.columns(), kForbidden, &memory_),
        bounds_(&memory_),
        parts_(&memory_),
        prices_(&memory_),
        columns_(&memory_),
        orders_(&memory_),
        queue_(&memory_) {}

  std::optional<Assignment> next();
  bool cut() const { return cut_; }

 private:
  Assignment first();
  Assignment best(int part) const;
  void keep(const RankedPart& part);
  void load(int part, int position);
  void split(int part);
  void orderRows(int part);
  void search(const Candidate& candidate);
  double bound(int part, int row);
  RowCost allowed(int part, int row);
  void push(double min_cost, int part, int position);
  Candidate pop();

  /// Number of stored entries of a part: prices of rows and columns, and the rows' columns.
  std::int64_t entriesOfPart() const { return 2 * std::int64_t{costs_.rows()} + costs_.columns(); }

  const int* columnsOf(int part) const {
    return columns_.data() + std::ptrdiff_t{part} * costs_.rows();
  }
  const int* orderOf(const RankedPart& part) const {
    return orders_.data() + std::ptrdiff_t{part.order} * costs_.rows();
  }

  alignas(std::max_align_t) std::array<std::byte, kFirstMemory> buffer_;
  std::pmr::monotonic_buffer_resource memory_;
  CostMatrix cost_;
  Eigen::VectorXd unassigned_cost_;
  AssignmentCosts costs_{cost_, unassigned_cost_, &memory_};
  RowsOfColumns rows_of_columns_;
  std::int64_t max_work_;
  std::int64_t own_work_ = 0;  ///< entries that were copied, or read for bounds
  bool cut_ = false;
  AugmentingPath path_;

  // For one part at a time.
  PricedAssignment present_;
  std::optional<double> into_void_;   ///< see minIntoVoid(); none: unknown
  std::pmr::vector<double> allowed_;  ///< costs of one row, for its possible columns
  std::pmr::vector<RowBound> bounds_;

  // For all parts, one after the other.
  std::pmr::vector<RankedPart> parts_;
  std::pmr::vector<double> prices_;  ///< of the rows, then of the columns
  std::pmr::vector<int> columns_;    ///< of the rows
  std::pmr::vector<int> orders_;     ///< of the rows, only for parts with their own order

  std::pmr::vector<Candidate> queue_;
  int pushed_ = 0;
  int returned_ = kNoIndex;  ///< the part whose best assignment was returned last
};

std::optional<Assignment> RankedAssignments::State::next() {
  if (cut_) {
    return std::nullopt;
  }
  if (parts_.empty()) {
    return first();
  }
  if (returned_ != kNoIndex) {
    split(std::exchange(returned_, kNoIndex));
  }
  while (!queue_.empty()) {
    if (path_.work() + own_work_ > max_work_) {
      cut_ = true;
      return std::nullopt;
    }
    const Candidate candidate = pop();
    if (candidate.position == kNoIndex) {
      returned_ = candidate.part;
      return best(candidate.part);
    }
    search(candidate);
  }
  return std::nullopt;
}

Assignment RankedAssignments::State::first() {
  cut_ = !assignAll(costs_, max_work_, path_, present_);
  orders_.resize(costs_.rows());
  std::iota(orders_.begin(), orders_.end(), 0);
  keep({});
  returned_ = 0;
  return best(0);
}

Assignment RankedAssignments::State::best(int part) const {
  return {{columnsOf(part), columnsOf(part) + costs_.rows()}, parts_[part].cost, cut_};
}

/// Stores the current assignment as the best of a new part.
void RankedAssignments::State::keep(const RankedPart& part) {
  own_work_ += entriesOfPart();
  parts_.push_back(part);
  parts_.back().cost = totalCost(present_.column_of_row, costs_);
  prices_.insert(prices_.end(), present_.row_price.begin(), present_.row_price.end());
  prices_.insert(prices_.end(), present_.column_price.begin(), present_.column_price.end());
  columns_.insert(columns_.end(), present_.column_of_row.begin(), present_.column_of_row.end());
}

/// Makes the best of a part the current assignment, with the rows from a position on open.
void RankedAssignments::State::load(int part, int position) {
  const int rows = costs_.rows();
  own_work_ += entriesOfPart();
  into_void_.reset();
  const double* prices = prices_.data() + std::ptrdiff_t{part} * (rows + costs_.columns());
  std::copy_n(prices, rows, present_.row_price.begin());
  std::copy_n(prices + rows, costs_.columns(), present_.column_price.begin());
  std::copy_n(columnsOf(part), rows, present_.column_of_row.begin());
  std::fill(present_.row_of_column.begin(), present_.row_of_column.end(), kUnassigned);
  const int* order = orderOf(parts_[part]);
  present_.openOnly(order + position, order + rows);
  for (int i = 0; i < rows; ++i) {
    const int column = present_.column_of_row[order[i]];
    if (column != kUnassigned) {
      present_.row_of_column[column] = i < position ? kFixed : order[i];
    }
  }
}

/// Queues all parts that remain of a part without its best assignment.
void RankedAssignments::State::split(int part) {
  const int first = parts_[part].position;
  load(part, first);
  if (costs_.rows() - first >= kRowsWorthOrdering) {
    orderRows(part);
  }
  const int* order = orderOf(parts_[part]);
  for (int position = first; position < costs_.rows(); ++position) {
    const int row = order[position];
    const double increase = bound(part, row);
    if (increase < kForbidden) {
      push(parts_[part].cost + increase, part, position);
    }
    present_.fix(row);
    if (present_.column_of_row[row] != kUnassigned) {
      into_void_.reset();  // not through this row any longer
    }
  }
}

/// The row that must differ stays first; then come rows for which another column costs most, so
/// that the largest parts have the costliest best, and most of them are never searched.
void RankedAssignments::State::orderRows(int part) {
  const int kept = parts_[part].position + (parts_[part].row == kNoIndex ? 0 : 1);
  const int* order = orderOf(parts_[part]);
  bounds_.clear();
  for (int position = kept; position < costs_.rows(); ++position) {
    const int row = order[position];
    bounds_.push_back({row, bound(part, row)});
  }
  std::sort(bounds_.begin(), bounds_.end(), [](const RowBound& a, const RowBound& b) {
    return a.increase != b.increase ? a.increase > b.increase : a.row < b.row;
  });
  const std::size_t begin = orders_.size();
  orders_.resize(begin + costs_.rows());
  std::copy_n(orderOf(parts_[part]), kept, orders_.begin() + begin);
  std::transform(bounds_.begin(), bounds_.end(), orders_.begin() + begin + kept,
                 [](const RowBound& bound) { return bound.row; });
  parts_[part].order = costs_.rows() == 0 ? 0 : static_cast<int>(begin) / costs_.rows();
}

/// Finds the best assignment of a part of a part, and queues it.
void RankedAssignments::State::search(const Candidate& candidate) {
  const RankedPart& whole = parts_[candidate.part];
  const int row = orderOf(whole)[candidate.position];
  load(candidate.part, candidate.position);
  if (path_.replace(row, allowed(candidate.part, row), present_)) {
    const int part = static_cast<int>(parts_.size());
    keep({candidate.part, candidate.position, row, 0.0, whole.order});
    push(parts_[part].cost, part, kNoIndex);
  }
}

/// Lower bound of the cost increase of the best of a part if this row differs.
double RankedAssignments::State::bound(int part, int row) {
  own_work_ += costs_.possible(row).size();
  if (!into_void_ && present_.column_of_row[row] == kUnassigned) {
    into_void_ = minIntoVoid(costs_, present_);
  }
  return minIncrease(row, allowed(part, row), costs_, rows_of_columns_, present_,
                     into_void_.value_or(kForbidden));
}

/// What a row may have that must differ from the part's best, and from all that was excluded from
/// the part before.
RowCost RankedAssignments::State::allowed(int part, int row) {
  RowCost cost = costs_.row(row);
  const Possible possible = costs_.possible(row);
  own_work_ += possible.size();
  for (const int column : possible) {  // no other one is read
    allowed_[column] = cost.columns[column];
  }
  cost.columns = allowed_.data();
  while (true) {
    const int column = columnsOf(part)[row];
    (column == kUnassigned ? cost.unassigned : allowed_[column]) = kForbidden;
    if (parts_[part].row != row) {
      return cost;
    }
    part = parts_[part].parent;
  }
}

void RankedAssignments::State::push(double min_cost, int part, int position) {
  queue_.push_back({min_cost, part, position, pushed_++});
  std::push_heap(queue_.begin(), queue_.end());
}

Candidate RankedAssignments::State::pop() {
  std::pop_heap(queue_.begin(), queue_.end());
  const Candidate candidate = queue_.back();
  queue_.pop_back();
  return candidate;
}

RankedAssignments::RankedAssignments(CostMatrix cost, Eigen::VectorXd unassigned_cost,
                                     std::int64_t max_work) {
  checkSizes(cost, unassigned_cost);
  state_ = std::make_unique<State>(std::move(cost), std::move(unassigned_cost), max_work);
}

RankedAssignments::~RankedAssignments() = default;
RankedAssignments::RankedAssignments(RankedAssignments&&) noexcept = default;
RankedAssignments& RankedAssignments::operator=(RankedAssignments&&) noexcept = default;

std::optional<Assignment> RankedAssignments::next() { return state_->next(); }

bool RankedAssignments::cut() const { return state_->cut(); }

}  // namespace datmo
