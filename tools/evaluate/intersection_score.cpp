// SPDX-License-Identifier: BSD-3-Clause
#include "evaluate/intersection_score.h"

#include <algorithm>

namespace datmo::evaluation {

namespace {

struct Stretch {
  Stamp first;
  Stamp last;

  bool overlaps(const Stretch& other) const { return first <= other.last && other.first <= last; }
};

std::vector<Stretch> stretchesOf(const std::vector<RecordedIntersection>& recorded,
                                 double merge_gap) {
  std::vector<Stretch> stretches;
  for (const RecordedIntersection& state : recorded) {
    if (!state.at_intersection) {
      continue;
    }
    if (stretches.empty() || secondsBetween(stretches.back().last, state.stamp) > merge_gap) {
      stretches.push_back({state.stamp, state.stamp});
    }
    stretches.back().last = state.stamp;
  }
  return stretches;
}

std::size_t countWithPartner(const std::vector<Stretch>& stretches,
                             const std::vector<Stretch>& others) {
  return static_cast<std::size_t>(
      std::count_if(stretches.begin(), stretches.end(), [&](const Stretch& stretch) {
        return std::any_of(others.begin(), others.end(),
                           [&](const Stretch& other) { return stretch.overlaps(other); });
      }));
}

}  // namespace

IntersectionScore scoreIntersections(
    const std::vector<RecordedIntersection>& truth,
    const std::optional<std::vector<RecordedIntersection>>& reported, double merge_gap) {
  const std::vector<Stretch> true_stretches = stretchesOf(truth, merge_gap);
  IntersectionScore score;
  score.intersections = true_stretches.size();
  if (reported) {
    const std::vector<Stretch> stretches = stretchesOf(*reported, merge_gap);
    score.found = countWithPartner(true_stretches, stretches);
    score.wrong = stretches.size() - countWithPartner(stretches, true_stretches);
  }
  return score;
}

}  // namespace datmo::evaluation
