// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/common/stamp.h"
#include "datmo_fusion/grid/hit_grid.h"
#include "datmo_fusion/road/border_search.h"
#include "datmo_fusion/road/road_model.h"
#include "datmo_fusion/road/road_opening.h"

namespace datmo {

struct SideStreetOptions {
  SideStreetOptions();

  double period = 0.25;  ///< s
  double memory = 3.0;   ///< s
  double start = 2.0;    ///< m
  BorderSearchOptions search;

  void visit(OptionVisitor& visitor);
};

/// Detects the borders of streets that open into the vehicle's: the border search of the thesis
/// (3.5) from the middle of each opening, as from a vehicle that looks into the street. New results
/// replace older ones that contradict them.
class SideStreets {
 public:
  /// Throws OptionError.
  explicit SideStreets(const Checked<SideStreetOptions>& options);

  /// Searches the openings if the period has elapsed; stamps must rise.
  void update(const HitGrid& hits, const std::vector<RoadOpening>& openings, Stamp stamp);

  /// Returns the borders found recently, in the map frame, from the vehicle's road outward.
  std::vector<RoadBorder> borders(Stamp stamp) const;

  /// Forgets everything, as after construction.
  void reset();

 private:
  struct Known {
    FoundBorder border;
    RoadSide of;  ///< side of the vehicle's road on which the street opens
    Stamp seen;
  };

  void lookInto(const HitGrid& hits, const RoadOpening& opening, Stamp stamp);

  SideStreetOptions options_;
  BorderSearch search_;
  std::vector<Known> known_;
  std::optional<Stamp> last_look_;
};

}  // namespace datmo
