// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/fusion/object/fused_existence.h"

#include <algorithm>
#include <cmath>

#include "datmo_fusion/common/log_odds.h"

namespace datmo {

namespace {

/// Even a certain tracker may be wrong: its probabilities stay between 1 - this and this.
constexpr double kMaxExistence = 0.999;

double logOdds(double probability) {
  return logOddsOf(std::clamp(probability, 1.0 - kMaxExistence, kMaxExistence));
}

}  // namespace

double fusedExistence(const std::vector<ExistenceReport>& reports) {
  const ExistenceReport* surest = nullptr;
  for (const ExistenceReport& one : reports) {
    if (one.has_track && (surest == nullptr || one.existence > surest->existence)) {
      surest = &one;
    }
  }
  if (surest == nullptr) {
    return 0.0;
  }
  double log_odds = logOdds(surest->existence);
  for (const ExistenceReport& one : reports) {
    if (&one == surest) {
      continue;
    }
    log_odds +=
        one.has_track
            ? std::log(std::max(1.0, one.detection_probability / one.false_agreement_probability))
            : std::log1p(-one.detection_probability * one.looked);
  }
  return probabilityOf(log_odds);
}

}  // namespace datmo
