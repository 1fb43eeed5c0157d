// SPDX-License-Identifier: BSD-3-Clause
#include "evaluate/pair_choice.h"

#include <algorithm>

#include "datmo_fusion/assignment/assignment.h"

namespace datmo::evaluation {

namespace {

/// The number of pairs of each row (or column).
std::vector<std::size_t> counts(const std::vector<PairGain>& pairs, std::size_t PairGain::*side) {
  std::size_t size = 0;
  for (const PairGain& pair : pairs) {
    size = std::max(size, pair.*side + 1);
  }
  std::vector<std::size_t> result(size, 0);
  for (const PairGain& pair : pairs) {
    ++result[pair.*side];
  }
  return result;
}

/// Consecutive numbers from 0 on for the rows (or columns) of the chosen pairs.
class Numbering {
 public:
  explicit Numbering(std::size_t size) : numbers_(size, kUnassigned) {}

  void add(std::size_t key) {
    if (numbers_[key] == kUnassigned) {
      numbers_[key] = size_++;
    }
  }
  int operator[](std::size_t key) const { return numbers_[key]; }
  int size() const { return size_; }

 private:
  std::vector<int> numbers_;
  int size_ = 0;
};

/// Adds the best of the contested pairs, given by their indices.
void solve(const std::vector<PairGain>& pairs, const std::vector<std::size_t>& contested,
           Numbering rows, Numbering columns, std::vector<std::size_t>& chosen) {
  for (const std::size_t index : contested) {
    rows.add(pairs[index].row);
    columns.add(pairs[index].column);
  }
  CostMatrix costs = CostMatrix::Constant(rows.size(), columns.size(), kForbidden);
  for (const std::size_t index : contested) {
    costs(rows[pairs[index].row], columns[pairs[index].column]) = -pairs[index].gain;
  }
  const Assignment assignment = solveAssignment(costs, Eigen::VectorXd::Zero(costs.rows()));
  for (const std::size_t index : contested) {
    const auto row = static_cast<std::size_t>(rows[pairs[index].row]);
    if (assignment.column_of_row[row] == columns[pairs[index].column]) {
      chosen.push_back(index);
    }
  }
}

}  // namespace

std::vector<std::size_t> choosePairs(const std::vector<PairGain>& pairs) {
  const std::vector<std::size_t> of_row = counts(pairs, &PairGain::row);
  const std::vector<std::size_t> of_column = counts(pairs, &PairGain::column);
  std::vector<std::size_t> chosen;
  std::vector<std::size_t> contested;
  chosen.reserve(pairs.size());
  for (std::size_t index = 0; index < pairs.size(); ++index) {
    const bool alone = of_row[pairs[index].row] == 1 && of_column[pairs[index].column] == 1;
    (alone ? chosen : contested).push_back(index);
  }
  if (!contested.empty()) {
    solve(pairs, contested, Numbering(of_row.size()), Numbering(of_column.size()), chosen);
    std::sort(chosen.begin(), chosen.end());
  }
  return chosen;
}

}  // namespace datmo::evaluation
