// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/tracking/existence_score.h"

#include <algorithm>
#include <cmath>

#include "datmo_fusion/common/log_odds.h"

namespace datmo {

void ExistenceOptions::visit(OptionVisitor& visitor) {
  visitor.number({"birth_probability", "1",
                  "probability that a new object of no target is something that will be tracked, "
                  "and not a false alarm"},
                 birth_probability, {1e-4, 0.9999});
  visitor.number(
      {"clutter_density", "1/m^2",
       "density of false objects that the clutter map does not resolve, added to its own: "
       "its cells are coarser than a row of parked cars"},
      clutter_density, {0.0, 100.0});
  visitor.number({"scan_limit", "1",
                  "most that one object may add to the score, or subtract: errors of a sensor "
                  "persist from scan to scan; misses count in full"},
                 scan_limit, {0.1, 100.0});
  visitor.number(
      {"max_score", "1", "upper limit of the score, so that a track that has lost its object ends"},
      max_score, {0.0, 100.0});
  visitor.number({"min_score", "1",
                  "lower limit of the score: 0 forgets that the first objects of a target did not "
                  "belong together"},
                 min_score, {-100.0, 0.0});
}

void ExistenceScore::detect(double log_likelihood, double detection_probability, double log_density,
                            double log_odds, const ExistenceOptions& options) {
  const double density = std::exp(log_density) + options.clutter_density;
  const double ratio = log_likelihood + std::log(detection_probability / density) + log_odds;
  add(std::clamp(ratio, -options.scan_limit, options.scan_limit), options);
}

void ExistenceScore::miss(double detection_probability, const ExistenceOptions& options) {
  add(std::log(1.0 - detection_probability), options);
}

double ExistenceScore::logOdds(const ExistenceOptions& options) const {
  return score_ + logOddsOf(options.birth_probability);
}

double ExistenceScore::probability(const ExistenceOptions& options) const {
  return probabilityOf(logOdds(options));
}

void ExistenceScore::add(double ratio, const ExistenceOptions& options) {
  score_ = std::clamp(score_ + ratio, options.min_score, options.max_score);
}

}  // namespace datmo
