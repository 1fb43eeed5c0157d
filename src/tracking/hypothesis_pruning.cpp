// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/tracking/hypothesis_pruning.h"

#include <cmath>
#include <functional>
#include <numeric>
#include <tuple>

namespace datmo {

namespace {

bool isBetter(const GlobalHypothesis& a, const GlobalHypothesis& b) {
  return std::make_tuple(-a.log_weight, std::cref(a.leaf_of_tree)) <
         std::make_tuple(-b.log_weight, std::cref(b.leaf_of_tree));
}

/// Logarithm of the sum of two probabilities given by their logarithms.
double logSum(double a, double b) {
  const double largest = std::max(a, b);
  return largest + std::log1p(std::exp(std::min(a, b) - largest));
}

}  // namespace

void sortByWeight(std::vector<GlobalHypothesis>& hypotheses) {
  std::sort(hypotheses.begin(), hypotheses.end(), isBetter);
  const double best = hypotheses.front().log_weight;
  for (GlobalHypothesis& hypothesis : hypotheses) {
    hypothesis.log_weight -= best;
  }
}

void mergeEqual(std::vector<GlobalHypothesis>& hypotheses) {
  if (hypotheses.size() < 2) {
    return;
  }
  std::vector<std::size_t> order(hypotheses.size());  // puts equal ones next to each other
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    const std::vector<int>& first = hypotheses[a].leaf_of_tree;
    const std::vector<int>& second = hypotheses[b].leaf_of_tree;
    return first < second || (first == second && a < b);
  });
  const auto isEqual = [&](std::size_t a, std::size_t b) {
    return hypotheses[a].leaf_of_tree == hypotheses[b].leaf_of_tree;
  };
  if (std::adjacent_find(order.begin(), order.end(), isEqual) == order.end()) {
    return;
  }
  std::vector<GlobalHypothesis> merged;
  for (const std::size_t index : order) {
    GlobalHypothesis& next = hypotheses[index];
    if (!merged.empty() && merged.back().leaf_of_tree == next.leaf_of_tree) {
      merged.back().log_weight = logSum(merged.back().log_weight, next.log_weight);
    } else {
      merged.push_back(std::move(next));
    }
  }
  hypotheses = std::move(merged);
}

}  // namespace datmo
