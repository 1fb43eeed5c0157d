#include "datmo_fusion/tracking/ranked_assignments.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory_resource>
#include <utility>
#include <vector>

#include "augmenting_path.h"
#include "priced_assignment.h"

namespace datmo {

namespace {

constexpr int kNone = -1;

/// The first memory of a ranking, bytes: enough for the first few assignments of a tiny problem.
constexpr std::size_t kFirstMemory = 4096;

/// The best assignment of a part: rows before `first_row` have what they have in all of the part.
struct Part {
  int parent = kNone;
  int first_row = 0;
  double cost = 0.0;
};

/// In the queue: the best assignment of a part that is known, or a part of a part that is not
/// searched yet.
struct Candidate {
  double least_cost = 0.0;  ///< exact where known, else a lower bound
  int part = 0;
  int row = kNone;  ///< the first that is to differ from the part's best; kNone: known
  int number = 0;

  /// Order of the queue, which has the greatest on top.
  bool operator<(const Candidate& other) const {
    return least_cost != other.least_cost ? least_cost > other.least_cost : number > other.number;
  }
};

}  // namespace

class RankedAssignments::State {
 public:
  State(CostMatrix cost, Eigen::VectorXd unassigned_cost, std::int64_t most_work)
      : memory_(buffer_.data(), buffer_.size()),
        cost_(std::move(cost)),
        unassigned_cost_(std::move(unassigned_cost)),
        most_work_(most_work),
        path_(cost_, unassigned_cost_, &memory_),
        present_(static_cast<int>(cost_.rows()), static_cast<int>(cost_.cols()), &memory_),
        allowed_(&memory_),
        parts_(&memory_),
        prices_(&memory_),
        columns_(&memory_),
        queue_(&memory_) {}

  std::optional<Assignment> next();
  bool cut() const { return cut_; }

 private:
  int rows() const { return static_cast<int>(cost_.rows()); }
  int columns() const { return static_cast<int>(cost_.cols()); }

  Assignment first();
  void keep(int parent, int first_row);
  void load(int part);
  void split(int part);
  void search(const Candidate& candidate);
  RowCost rowCost(int part, int row);
  double leastIncrease(int row, const RowCost& row_cost) const;
  double leastOut(int row, const RowCost& row_cost) const;
  double leastIn(int row) const;
  double leastIntoColumn(int column, int row) const;
  double leastIntoVoid(int row) const;
  void push(double least_cost, int part, int row);
  Candidate pop();

  alignas(std::max_align_t) std::array<std::byte, kFirstMemory> buffer_;
  std::pmr::monotonic_buffer_resource memory_;
  CostMatrix cost_;
  Eigen::VectorXd unassigned_cost_;
  std::int64_t most_work_;
  bool cut_ = false;
  AugmentingPath path_;

  /// Of one part at a time.
  PricedAssignment present_;
  std::pmr::vector<double> allowed_;
  double allowed_unassigned_ = 0.0;

  std::pmr::vector<Part> parts_;
  std::pmr::vector<double> prices_;  ///< of the rows, then the columns, of one part after the other
  std::pmr::vector<int> columns_;    ///< of the rows of one part after the other
  std::pmr::vector<Candidate> queue_;
  int pushed_ = 0;
  int returned_ = kNone;  ///< the part whose best was returned last
};

std::optional<Assignment> RankedAssignments::State::next() {
  if (cut_) {
    return std::nullopt;
  }
  if (parts_.empty()) {
    return first();
  }
  if (returned_ != kNone) {
    split(std::exchange(returned_, kNone));
  }
  while (!queue_.empty()) {
    if (path_.work() > most_work_) {
      cut_ = true;
      return std::nullopt;
    }
    const Candidate candidate = pop();
    if (candidate.row == kNone) {
      returned_ = candidate.part;
      const auto begin = columns_.begin() + std::ptrdiff_t{candidate.part} * rows();
      return Assignment{{begin, begin + rows()}, candidate.least_cost};
    }
    search(candidate);
  }
  return std::nullopt;
}

Assignment RankedAssignments::State::first() {
  cut_ = !assignAll(cost_, unassigned_cost_, most_work_, path_, present_);
  keep(kNone, 0);
  returned_ = 0;
  return {{columns_.begin(), columns_.end()}, parts_.front().cost, cut_};
}

/// Keeps the present assignment as the best of a new part.
void RankedAssignments::State::keep(int parent, int first_row) {
  parts_.push_back({parent, first_row, totalCost(present_.column_of_row, cost_, unassigned_cost_)});
  prices_.insert(prices_.end(), present_.row_price.begin(), present_.row_price.end());
  prices_.insert(prices_.end(), present_.column_price.begin(), present_.column_price.end());
  columns_.insert(columns_.end(), present_.column_of_row.begin(), present_.column_of_row.end());
}

void RankedAssignments::State::load(int part) {
  const auto prices = prices_.begin() + std::ptrdiff_t{part} * (rows() + columns());
  std::copy_n(prices, rows(), present_.row_price.begin());
  std::copy_n(prices + rows(), columns(), present_.column_price.begin());
  std::copy_n(columns_.begin() + std::ptrdiff_t{part} * rows(), rows(),
              present_.column_of_row.begin());
  std::fill(present_.row_of_column.begin(), present_.row_of_column.end(), kUnassigned);
  for (int row = 0; row < rows(); ++row) {
    if (present_.column_of_row[row] != kUnassigned) {
      present_.row_of_column[present_.column_of_row[row]] = row;
    }
  }
}

/// Queues all that is left of a part without its best.
void RankedAssignments::State::split(int part) {
  load(part);
  for (int row = parts_[part].first_row; row < rows(); ++row) {
    const double increase = leastIncrease(row, rowCost(part, row));
    if (increase < kForbidden) {
      push(parts_[part].cost + increase, part, row);
    }
  }
}

/// Finds the best of a part of a part, and queues it.
void RankedAssignments::State::search(const Candidate& candidate) {
  load(candidate.part);
  if (path_.replace(candidate.row, rowCost(candidate.part, candidate.row), present_)) {
    const int part = static_cast<int>(parts_.size());
    keep(candidate.part, candidate.row);
    push(parts_[part].cost, part, kNone);
  }
}

/// What a row may have that is to differ from the part's best, and from all that was taken away
/// from the part before.
RowCost RankedAssignments::State::rowCost(int part, int row) {
  const double* costs = cost_.row(row).data();
  allowed_.assign(costs, costs + columns());
  allowed_unassigned_ = unassigned_cost_[row];
  while (true) {
    const int column = columns_[std::ptrdiff_t{part} * rows() + row];
    (column == kUnassigned ? allowed_unassigned_ : allowed_[column]) = kForbidden;
    if (parts_[part].parent == kNone || parts_[part].first_row != row) {
      return {allowed_.data(), allowed_unassigned_};
    }
    part = parts_[part].parent;
  }
}

/// Bound from below of how much dearer the best of a part becomes once a row may only have what
/// `row_cost` allows: the first step of the path, and its last.
double RankedAssignments::State::leastIncrease(int row, const RowCost& row_cost) const {
  const double out = leastOut(row, row_cost);
  return out < kForbidden ? std::max(out + leastIn(row), 0.0) : kForbidden;
}

double RankedAssignments::State::leastOut(int row, const RowCost& row_cost) const {
  double least = row_cost.unassigned;
  for (int column = 0; column < columns(); ++column) {
    const int taken_by = present_.row_of_column[column];
    if (taken_by == kUnassigned || taken_by > row) {
      least = std::min(least, row_cost.columns[column] - present_.column_price[column]);
    }
  }
  return least - present_.row_price[row];
}

double RankedAssignments::State::leastIn(int row) const {
  const int target = present_.column_of_row[row];
  return target == kUnassigned ? leastIntoVoid(row) : leastIntoColumn(target, row);
}

/// From the void, where the column may stay, or from a later row.
double RankedAssignments::State::leastIntoColumn(int column, int row) const {
  double least = 0.0;
  for (int other = row + 1; other < rows(); ++other) {
    least = std::min(least, cost_(other, column) - present_.row_price[other]);
  }
  return least - present_.column_price[column];
}

/// From a later row that gives its column up, or from a free column.
double RankedAssignments::State::leastIntoVoid(int row) const {
  double least = kForbidden;
  for (int other = row + 1; other < rows(); ++other) {
    if (present_.column_of_row[other] != kUnassigned) {
      least = std::min(least, unassigned_cost_[other] - present_.row_price[other]);
    }
  }
  for (int column = 0; column < columns(); ++column) {
    if (present_.row_of_column[column] == kUnassigned) {
      least = std::min(least, present_.column_price[column]);
    }
  }
  return least;
}

void RankedAssignments::State::push(double least_cost, int part, int row) {
  queue_.push_back({least_cost, part, row, pushed_++});
  std::push_heap(queue_.begin(), queue_.end());
}

Candidate RankedAssignments::State::pop() {
  std::pop_heap(queue_.begin(), queue_.end());
  const Candidate candidate = queue_.back();
  queue_.pop_back();
  return candidate;
}

RankedAssignments::RankedAssignments(CostMatrix cost, Eigen::VectorXd unassigned_cost,
                                     std::int64_t most_work) {
  checkSizes(cost, unassigned_cost);
  state_ = std::make_unique<State>(std::move(cost), std::move(unassigned_cost), most_work);
}

RankedAssignments::~RankedAssignments() = default;
RankedAssignments::RankedAssignments(RankedAssignments&&) noexcept = default;
RankedAssignments& RankedAssignments::operator=(RankedAssignments&&) noexcept = default;

std::optional<Assignment> RankedAssignments::next() { return state_->next(); }

bool RankedAssignments::cut() const { return state_->cut(); }

}  // namespace datmo
