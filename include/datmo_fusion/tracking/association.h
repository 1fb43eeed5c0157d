// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/tracking/association_scan.h"
#include "datmo_fusion/tracking/target.h"

namespace datmo {

struct AssociationOptions {
  double gate = 13.8;            ///< 1
  double min_same_class = 0.02;  ///< 1
  int max_candidates = 8;
  int max_targets = 600;
  int max_work = 2000000;

  void visit(OptionVisitor& visitor);
};

/// An observation that may belong to a target.
struct Candidate {
  std::size_t observation;
  double score;  ///< log-likelihood ratio of "detected, as this observation" versus "missed, and
                 ///< this observation is of no target"
};

/// How well the observations of a scan fit a target.
struct TargetScores {
  double detection_probability = 0.0;  ///< given that it exists
  double missed = 0.0;                 ///< log probability that it is not detected
  double seen = 0.0;                   ///< log odds that it is detected
  std::vector<Candidate> candidates;   ///< the nearest ones, by ascending observation
};

/// Returns the scores of a target that was predicted to the scan's time and exists with this
/// probability (Blackman, Multiple Hypothesis Tracking for Multiple Target Tracking, 2004;
/// existence: Garcia-Fernandez et al., Poisson multi-Bernoulli mixture filter, 2018). Only single
/// objects are candidates.
///
/// Thesis 3.3.4 ignores all pairs of different classes. Here, pairs whose classes surely differ are
/// not candidates, and otherwise the probability that they differ counts against them, so that an
/// occasional misclassification does not break a track.
///
/// `memory`: scores that are no longer needed, whose memory is reused.
TargetScores scoresOf(const Target& target, const AssociationScan& scan, double existence,
                      const AssociationOptions& options, TargetScores memory = {});

/// Adds an observation to the candidates if it is within the target's gate.
void addCandidate(const Target& target, const AssociationScan& scan, std::size_t observation,
                  const AssociationOptions& options, TargetScores& scores);

}  // namespace datmo
