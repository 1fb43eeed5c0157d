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

/// An observation that may be of a target.
struct Candidate {
  std::size_t observation;
  double score;  ///< log-likelihood ratio of "seen, and this is it" against "missed, and this is
                 ///< of no target"
};

/// How well the observations of a scan fit a target.
struct TargetScores {
  double detection_probability = 0.0;  ///< if it exists
  double missed = 0.0;                 ///< logarithm of the probability that it is not seen
  double seen = 0.0;                   ///< logarithm of the odds that it is seen
  std::vector<Candidate> candidates;   ///< the nearest ones, by rising observation
};

/// Scores of a target that was predicted to the scan's time and exists with this probability
/// (Blackman, Multiple Hypothesis Tracking for Multiple Target Tracking, 2004; existence:
/// Garcia-Fernandez et al., Poisson multi-Bernoulli mixture filter, 2018). Only objects by
/// themselves are candidates.
///
/// Thesis 3.3.4 ignores all pairs of different classes. Here those that are surely different are no
/// candidates, and of others the probability that they differ counts against them: so a class that
/// the sensor mistakes for another now and then does not break a track.
///
/// `memory`: scores that are of no use any more, to go without new memory.
TargetScores scoresOf(const Target& target, const AssociationScan& scan, double existence,
                      const AssociationOptions& options, TargetScores memory = {});

/// Adds an observation to the candidates if it is within the target's gate.
void addCandidate(const Target& target, const AssociationScan& scan, std::size_t observation,
                  const AssociationOptions& options, TargetScores& scores);

}  // namespace datmo
