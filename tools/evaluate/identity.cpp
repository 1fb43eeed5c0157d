// SPDX-License-Identifier: BSD-3-Clause
#include "evaluate/identity.h"

#include "evaluate/pair_choice.h"

namespace datmo::evaluation {

namespace {

/// Frames in which object and track agree, in the best assignment of whole trajectories (IDTP).
double agreeingFrames(const ScoredRun& run) {
  std::vector<PairGain> pairs;
  for (const Encounter& encounter : run.encounters) {
    pairs.push_back({encounter.object, encounter.track, 0.0});
  }
  for (const std::vector<ScoredPair>& frame : run.frames) {
    for (const ScoredPair& pair : frame) {
      pairs[pair.encounter].gain += 1.0;
    }
  }
  double result = 0.0;
  for (const std::size_t index : choosePairs(pairs)) {
    result += pairs[index].gain;
  }
  return result;
}

std::optional<double> ratio(double part, double whole) {
  return whole > 0.0 ? std::optional<double>(part / whole) : std::nullopt;
}

}  // namespace

IdentityScores scoreIdentity(const ScoredRun& run) {
  const double agreeing = agreeingFrames(run);
  const double required = run.required();
  const double published = run.published();
  return {ratio(2.0 * agreeing, required + published), ratio(agreeing, published),
          ratio(agreeing, required)};
}

}  // namespace datmo::evaluation
