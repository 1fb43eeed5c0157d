// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "datmo_fusion/common/options.h"

namespace datmo {

struct ExistenceOptions {
  double birth_probability = 0.5;  ///< 1
  double clutter_density = 0.005;  ///< 1/m^2
  double scan_limit = 1.0;         ///< 1
  double max_score = 11.0;         ///< 1
  double min_score = -2.0;         ///< 1

  void visit(OptionVisitor& visitor);
};

/// How much likelier the objects of a target are for one road user than for clutter: the track
/// score (Sittler 1964; Blackman, Multiple hypothesis tracking for multiple target tracking, 2004),
/// a sum of log-likelihood ratios over scans, limited on both sides so that a track that lost its
/// object ends (CUSUM: Page, Continuous inspection schemes, 1954).
class ExistenceScore {
 public:
  /// Of a new target. `log_odds`: that its first object is one at all, by its detector.
  ExistenceScore(double log_odds, const ExistenceOptions& options) { add(log_odds, options); }

  /// The present scan shows an object of this target. `log_likelihood`: of its position by the
  /// target's filter, logarithm of a density of 1/m^2; `detection_probability`: that it would be
  /// seen there, more than 0; `log_density`: of the density of objects that are of no target,
  /// 1/m^2; `log_odds`: that the object is one at all, by its detector.
  void detect(double log_likelihood, double detection_probability, double log_density,
              double log_odds, const ExistenceOptions& options);

  /// The present scan shows no object of this target, and would have with this probability, less
  /// than 1.
  void miss(double detection_probability, const ExistenceOptions& options);

  double score() const { return score_; }

  /// Logarithm of the odds that it exists.
  double logOdds(const ExistenceOptions& options) const;

  /// That it exists, 0 to 1.
  double probability(const ExistenceOptions& options) const;

 private:
  void add(double ratio, const ExistenceOptions& options);

  double score_ = 0.0;
};

}  // namespace datmo
