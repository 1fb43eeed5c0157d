// SPDX-License-Identifier: BSD-3-Clause
#include "ranked_hypothesis.h"

#include <algorithm>
#include <utility>

namespace datmo {

namespace {

/// Reward for a target of an observation that needs one, larger than all scores together, so that
/// assignments in which all have one come first.
constexpr double kReward = 1e6;

}  // namespace

RankedHypothesis::RankedHypothesis(const HypothesisCluster& cluster, const AssociationScan& scan,
                                   const GlobalHypothesis& parent,
                                   const Interpretation& interpretation)
    : cluster_(&cluster),
      parent_(&parent),
      interpretation_(&interpretation),
      base_(parent.log_weight) {
  for (std::size_t tree = 0; tree < cluster.trees.size(); ++tree) {
    if (parent.leaf_of_tree[tree] != kAbsent) {
      rows_.push_back(tree);
      base_ += scores(tree).missed;
    }
  }
  for (std::size_t column = 0; column < interpretation.size(); ++column) {
    if (scan.observations[interpretation[column]].needsTarget()) {
      required_columns_.push_back(static_cast<int>(column));
    }
  }
}

double RankedHypothesis::bound() const {
  double bound = base_;
  for (const std::size_t tree : rows_) {
    double best = 0.0;
    for (const Candidate& candidate : scores(tree).candidates) {
      best = std::max(best, candidate.score);
    }
    bound += best;
  }
  return bound;
}

void RankedHypothesis::rank(std::int64_t max_work) {
  const Interpretation& columns = *interpretation_;
  CostMatrix costs(rows_.size(), columns.size());
  costs.setConstant(kForbidden);
  for (std::size_t row = 0; row < rows_.size(); ++row) {
    for (const Candidate& candidate : scores(rows_[row]).candidates) {
      const auto found = std::lower_bound(columns.begin(), columns.end(), candidate.observation);
      if (found != columns.end() && *found == candidate.observation) {
        costs(static_cast<Eigen::Index>(row), found - columns.begin()) = -candidate.score;
      }
    }
  }
  for (const int column : required_columns_) {
    costs.col(column).array() -= kReward;
  }
  const Eigen::VectorXd no_cost = Eigen::VectorXd::Zero(costs.rows());
  ranked_ = std::make_unique<RankedAssignments>(std::move(costs), no_cost, max_work);
  advance();
}

void RankedHypothesis::advance() {
  present_ = ranked_->next();
  if (present_ && !isComplete()) {
    present_.reset();
  }
}

bool RankedHypothesis::isComplete() const {
  const std::vector<int>& columns = present_->column_of_row;
  return std::all_of(required_columns_.begin(), required_columns_.end(), [&](int column) {
    return std::find(columns.begin(), columns.end(), column) != columns.end();
  });
}

double RankedHypothesis::weight() const {
  return base_ - (present_->cost + kReward * static_cast<double>(required_columns_.size()));
}

std::vector<std::size_t> RankedHypothesis::observations() const {
  std::vector<std::size_t> result(cluster_->trees.size(), kUnseen);
  for (std::size_t row = 0; row < rows_.size(); ++row) {
    const int column = present_->column_of_row[row];
    if (column != kUnassigned) {
      result[rows_[row]] = (*interpretation_)[static_cast<std::size_t>(column)];
    }
  }
  return result;
}

const TargetScores& RankedHypothesis::scores(std::size_t tree) const {
  const auto leaf = static_cast<std::size_t>(parent_->leaf_of_tree[tree]);
  return cluster_->trees[tree].leaves[leaf].scores;
}

}  // namespace datmo
