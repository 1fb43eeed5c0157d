#include "datmo_fusion/road/arrival_test.h"

#include <algorithm>
#include <cmath>

namespace datmo {

ArrivalTest::ArrivalTest(const ArrivalTestOptions& options) : options_(options) {
  checkOptions(options);
}

void ArrivalTestOptions::visit(OptionVisitor& visitor) {
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
  visitor.number({"longest_presence", "s", "for which a moving object stays at one position"},
                 longest_presence, {0.0, 60.0});
  visitor.integer({"most_places", "1", "points of an object that are evaluated"}, most_places,
                  {1, 1000});
}

double ArrivalTest::evidence(const SightHistory& history,
                             const std::vector<SightPlace>& places) const {
  const std::size_t taken = std::min(places.size(), static_cast<std::size_t>(options_.most_places));
  double sum = 0.0;
  for (std::size_t i = 0; i < taken; ++i) {
    sum += evidenceAt(history, places[(2 * i + 1) * places.size() / (2 * taken)]);
  }
  return sum / static_cast<double>(taken);
}

double ArrivalTest::evidenceAt(const SightHistory& history, const SightPlace& place) const {
  const double ghost = options_.seen_of_ghost;
  const auto ratio = [ghost](double seen, Sight sight) {
    return sight == Sight::kHit ? std::log(seen / ghost) : std::log((1.0 - seen) / (1.0 - ghost));
  };
  double there = 0.0;       // of what was seen since it came
  double gone_since = 0.0;  // of the same if it had come just now
  double best_difference = 0.0;
  double gone_to_best = 0.0;
  for (std::size_t back = 0; back < history.size(); ++back) {
    const Sight sight = history.look(back, place);
    if (sight == Sight::kNothing) {
      continue;
    }
    there += ratio(options_.seen_when_there, sight);
    gone_since += ratio(options_.seen_when_gone, sight);
    if (history.age(back) <= options_.longest_presence && there - gone_since > best_difference) {
      best_difference = there - gone_since;
      gone_to_best = gone_since;
    }
  }
  return gone_since - gone_to_best;
}

}  // namespace datmo
