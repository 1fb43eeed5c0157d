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

/// The borders of streets that open into the vehicle's: the search for borders of the thesis (3.5)
/// from the middle of each opening, as from a vehicle that looks into the street. What it finds
/// last takes the place of what contradicts it.
class SideStreets {
 public:
  /// Throws OptionError.
  explicit SideStreets(const Checked<SideStreetOptions>& options);

  /// Looks into the openings if it is time to; stamps rise.
  void update(const HitGrid& hits, const std::vector<RoadOpening>& openings, Stamp stamp);

  /// Those found of late, in the map frame, from the vehicle's road outward.
  std::vector<RoadBorder> borders(Stamp stamp) const;

  /// Forgets all, as at the start.
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
