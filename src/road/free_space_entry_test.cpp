// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/road/free_space_entry_test.h"

#include <algorithm>
#include <cmath>

namespace datmo {

FreeSpaceEntryTest::FreeSpaceEntryTest(const FreeSpaceEntryTestOptions& options)
    : options_(options) {
  checkOptions(options);
}

void FreeSpaceEntryTestOptions::visit(OptionVisitor& visitor) {
  const Bounds share{0.001, 0.999};
  visitor.number({"seen_when_there", "1", "share of the scans that see an object where it is"},
                 seen_when_there, share);
  visitor.number({"seen_when_gone", "1", "share of the scans that see something where nothing is"},
                 seen_when_gone, share);
  visitor.number(
      {"seen_of_ghost", "1",
       "share of the scans that see something where the background itself reflects now and "
       "then, rather too low"},
      seen_of_ghost, share);
  visitor.number({"max_presence", "s", "for which a moving object stays at one position"},
                 max_presence, {0.0, 60.0});
  visitor.integer({"max_points", "1", "points of an object that are evaluated"}, max_points,
                  {1, 1000});
}

double FreeSpaceEntryTest::evidence(const ScanHistory& history,
                                    const std::vector<ReflectionPoint>& positions) const {
  const std::size_t taken =
      std::min(positions.size(), static_cast<std::size_t>(options_.max_points));
  double sum = 0.0;
  for (std::size_t i = 0; i < taken; ++i) {
    sum += evidenceAt(history, positions[(2 * i + 1) * positions.size() / (2 * taken)]);
  }
  return sum / static_cast<double>(taken);
}

double FreeSpaceEntryTest::evidenceAt(const ScanHistory& history,
                                      const ReflectionPoint& position) const {
  const double ghost = options_.seen_of_ghost;
  const auto ratio = [ghost](double seen, BeamOutcome outcome) {
    return outcome == BeamOutcome::kHit ? std::log(seen / ghost)
                                        : std::log((1.0 - seen) / (1.0 - ghost));
  };
  double there = 0.0;       // of what was seen since it came
  double gone_since = 0.0;  // of the same if it had come just now
  double best_difference = 0.0;
  double gone_to_best = 0.0;
  for (std::size_t back = 0; back < history.size(); ++back) {
    const BeamOutcome outcome = history.look(back, position);
    if (outcome == BeamOutcome::kNothing) {
      continue;
    }
    there += ratio(options_.seen_when_there, outcome);
    gone_since += ratio(options_.seen_when_gone, outcome);
    if (history.age(back) <= options_.max_presence && there - gone_since > best_difference) {
      best_difference = there - gone_since;
      gone_to_best = gone_since;
    }
  }
  return gone_since - gone_to_best;
}

}  // namespace datmo
