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

/// Log-likelihood ratio of a target's objects being from one road user versus clutter: the track
/// score (Sittler 1964; Blackman, Multiple hypothesis tracking for multiple target tracking, 2004),
/// a sum over scans, limited on both sides so that a track that has lost its object ends (CUSUM:
/// Page, Continuous inspection schemes, 1954).
class ExistenceScore {
 public:
  /// Score of a new target. `log_odds`: of its first object being real, by its detector.
  ExistenceScore(double log_odds, const ExistenceOptions& options) { add(log_odds, options); }

  /// Updates with a detection. `log_likelihood`: of its position given the target's filter, log of
  /// a density in 1/m^2; `detection_probability`: of the target there, more than 0; `log_density`:
  /// log density of objects of no target, 1/m^2; `log_odds`: of the object being real, by its
  /// detector.
  void detect(double log_likelihood, double detection_probability, double log_density,
              double log_odds, const ExistenceOptions& options);

  /// Updates with a missed detection; `detection_probability` is less than 1.
  void miss(double detection_probability, const ExistenceOptions& options);

  double score() const { return score_; }

  /// Returns the log odds of existence.
  double logOdds(const ExistenceOptions& options) const;

  /// Returns the existence probability, 0 to 1.
  double probability(const ExistenceOptions& options) const;

 private:
  void add(double ratio, const ExistenceOptions& options);

  double score_ = 0.0;
};

}  // namespace datmo
