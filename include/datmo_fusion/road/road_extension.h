// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/road/border_offset.h"
#include "datmo_fusion/road/road_model.h"

namespace datmo {

struct RoadExtensionOptions {
  double length = 30.0;  ///< m

  void visit(OptionVisitor& visitor);
};

/// Extrapolates the edge of the road where no border is known: the nearest known border is extended
/// straight, across the mouth of a side street, past occlusions, and for a while after the last of
/// it was seen. This is a guess, good enough as a prior for objects out there.
class RoadExtension {
 public:
  explicit RoadExtension(const Checked<RoadExtensionOptions>& options);

  /// Sets the road as currently known, and the vehicle in its frame.
  void update(const RoadModel& road, const Pose2& base_in_map);

  /// Returns the offset of a point (m, map frame) from the extended border of one side; none if no
  /// border of that side is known nearby.
  std::optional<BorderOffset> offset(RoadSide side, const Point2& position) const;

  /// Forgets everything, as after construction.
  void reset();

 private:
  /// One side of the road.
  struct Side {
    std::vector<Pose2> ends;     ///< of borders; heading: away from the border
    std::optional<Pose2> last;   ///< nearest to the vehicle when a border was last known beside it
    Point2 seen_from{0.0, 0.0};  ///< m, the vehicle's position at that time
  };

  static void addEnds(const RoadBorder& border, Side& side);
  void remember(const RoadBorder& border, const Pose2& base_in_map, Side& side) const;

  RoadExtensionOptions options_;
  std::array<Side, 2> sides_;
};

}  // namespace datmo
