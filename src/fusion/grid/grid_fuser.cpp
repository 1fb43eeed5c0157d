// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/fusion/grid/grid_fuser.h"

#include <cmath>
#include <cstddef>
#include <deque>

#include "datmo_fusion/fusion/grid/grid_motion.h"
#include "datmo_fusion/fusion/sync/names_in_use.h"

namespace datmo {

GridFuserOptions::GridFuserOptions() {
  GridSourceOptions& lidar = sources["lidar"];
  lidar.priority = 0;
  lidar.reliability = 0.8;
  GridSourceOptions& stereo = sources["stereo"];
  stereo.priority = 1;
  stereo.reliability = 0.9;
  GridSourceOptions& mono = sources["mono"];
  mono.use = false;
  mono.priority = 1;
  mono.reliability = 0.7;
}

void GridFuserOptions::visit(OptionVisitor& visitor) {
  visitor.choice(
      {"rule", "",
       "how the evidence of several sensors on a cell is combined: weighted mean (thesis eq. "
       "3.2.5), the value of the first that sees it (3.2.6), the most occupied (4.1.8), Bayes for "
       "independent sensors, or evidence theory (perspective of 6.2)",
       Tier::kLive},
      rule,
      {{"weighted_sum", FusionRule::kWeightedSum},
       {"priority", FusionRule::kPriority},
       {"maximum", FusionRule::kMaximum},
       {"log_odds", FusionRule::kLogOdds},
       {"dempster_shafer", FusionRule::kDempsterShafer}});
  visitor.number({"mover_speed", "m/s",
                  "a cell is not marked free if something this fast may have entered it between a "
                  "source's stamp and the reference's (thesis: 0)",
                  Tier::kPublic},
                 mover_speed, {0.0, 100.0});
  visitor.each({"sources", "", "the sensors whose grids are fused"}, sources);
}

std::vector<std::string> GridFuserOptions::sourcesInUse() const { return namesInUse(sources); }

GridFuser::GridFuser(const Checked<GridFuserOptions>& options) : options_(*options) {}

FusionResult GridFuser::fuse(const MatchedGrids& matched, const MotionBetween& motion) const {
  FusionResult result;
  result.missing = matched.missing;
  std::deque<SensorGrid> moved;  // storage for `grids`
  std::vector<WeightedGrid> grids;
  for (const MatchedGrid& one : matched.samples) {
    const std::optional<Pose2> base = baseAt(one.stamp, matched.stamp(), motion);
    if (!base) {
      result.missing.push_back({one.source, WhyMissing::kNoMotion});
      continue;
    }
    const SensorGrid* grid = one.payload.get();
    if (grid->stamp() != matched.stamp()) {
      const double apart = std::abs(secondsBetween(grid->stamp(), matched.stamp()));
      moved.push_back(movedGrid(*grid, matched.stamp(), *base, options_.mover_speed * apart));
      grid = &moved.back();
    }
    grids.push_back({grid, options_.sources.at(one.source)});
  }
  result.grids = fuseGrids(options_.rule, grids);
  return result;
}

}  // namespace datmo
