// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/tracking/tracker_options.h"

namespace datmo {

void TrackerOptions::visit(OptionVisitor& visitor) {
  visitor.choice(
      {"association", "",
       "how objects are associated with targets: multiple hypotheses over several scans (Reid "
       "1979; thesis 3.3.4), or the global nearest neighbor of each scan by itself"},
      association,
      {{"mht", TrackerAssociation::kMultipleHypotheses},
       {"gnn", TrackerAssociation::kGlobalNearestNeighbor}});
  visitor.group("hypotheses", [&] { hypotheses.visit(visitor); });
  visitor.group("split_merge", [&] { split_merge.visit(visitor); });
  visitor.group("intake", [&] { intake.visit(visitor); });
  visitor.group("gating", [&] { gating.visit(visitor); });
  visitor.group("clutter", [&] { clutter.visit(visitor); });
  visitor.group("visibility", [&] { visibility.visit(visitor); });
  visitor.group("scans", [&] { scans.visit(visitor); });
  visitor.group("target", [&] { target.visit(visitor); });
  visitor.group("duplicates", [&] { duplicates.visit(visitor); });
  visitor.toggle(
      {"require_motion", "",
       "only targets that move according to target/motion_likelihood/required_probability become "
       "tracks; off: all that exist, for detectors that distinguish road users from other objects"},
      require_motion);
  constexpr Bounds kHits{1, 100};
  visitor.integer({"confirmation_hits", "1",
                   "number of objects before a track is published (thesis 3.3.4: three steps)"},
                  confirmation_hits, kHits);
  constexpr Bounds kProbability{0.0, 1.0};
  visitor.number(
      {"confirmation_existence", "1", "existence probability above which a target is confirmed"},
      confirmation_existence, kProbability);
  visitor.number(
      {"min_existence", "1", "existence probability below which a confirmed track is deleted"},
      min_existence, kProbability);
  visitor.number({"published_existence", "1",
                  "existence probability above which a confirmed track is published", Tier::kLive},
                 published_existence, kProbability);
  constexpr Bounds kSilence{0.0, 60.0};
  visitor.number({"tentative_silence", "s", "an unconfirmed target not seen for longer is deleted"},
                 tentative_silence, kSilence);
  visitor.number({"confirmed_silence", "s",
                  "a confirmed track not seen for longer is deleted; sooner if it was tracked for "
                  "a shorter time, but not before 0.5 s"},
                 confirmed_silence, kSilence);
  visitor.number({"published_silence", "s",
                  "a track not seen for longer is not published; sooner if it was tracked for less "
                  "than twice that, but not before 0.5 s",
                  Tier::kLive},
                 published_silence, kSilence);
  visitor.number(
      {"max_position_std", "m",
       "a target is deleted when the standard deviation of its position is larger", Tier::kPublic},
      max_position_std, {0.1, 100.0});
  visitor.number({"history_time", "s", "how much of its path is published with a track"},
                 history_time, {0.0, 60.0});
  visitor.number({"time_budget", "s",
                  "a step that takes longer continues with the most likely hypothesis alone"},
                 time_budget, {1e-4, 10.0});
}

}  // namespace datmo
