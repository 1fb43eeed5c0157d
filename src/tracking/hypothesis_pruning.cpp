// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/tracking/hypothesis_pruning.h"

#include <cmath>
#include <functional>
#include <map>
#include <tuple>

namespace datmo {

namespace {

bool isBetter(const GlobalHypothesis& a, const GlobalHypothesis& b) {
  return std::make_tuple(-a.log_weight, std::cref(a.leaf_of_tree)) <
         std::make_tuple(-b.log_weight, std::cref(b.leaf_of_tree));
}

/// Of two sums of probabilities given by their logarithms.
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
  std::map<std::vector<int>, double> weights;
  for (const GlobalHypothesis& hypothesis : hypotheses) {
    const auto found = weights.emplace(hypothesis.leaf_of_tree, hypothesis.log_weight);
    if (!found.second) {
      found.first->second = logSum(found.first->second, hypothesis.log_weight);
    }
  }
  if (weights.size() < hypotheses.size()) {
    hypotheses.clear();
    for (const auto& entry : weights) {
      hypotheses.push_back({entry.second, entry.first});
    }
  }
}

}  // namespace datmo
