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

/// Where the road ends beside stretches without a known border: there the nearest known border is
/// taken to go straight on, over the mouth of a side street, past what hides it, and for a time
/// after the last of it was seen. A guess: good enough to ask who is out there how he came there.
class RoadExtension {
 public:
  explicit RoadExtension(const Checked<RoadExtensionOptions>& options);

  /// The road as it is known now, and the vehicle in its frame.
  void update(const RoadModel& road, const Pose2& base_in_map);

  /// Where a point (m, map frame) lies beside the border of one side that goes on; none if no
  /// border of that side is known nearby.
  std::optional<BorderOffset> offset(RoadSide side, const Point2& position) const;

  /// Forgets all, as at the start.
  void reset();

 private:
  /// One side of the road.
  struct Side {
    std::vector<Pose2> ends;     ///< of borders; heading: away from the border
    std::optional<Pose2> last;   ///< nearest to the vehicle when one was known beside it
    Point2 seen_from{0.0, 0.0};  ///< m, the vehicle then
  };

  static void addEnds(const RoadBorder& border, Side& side);
  void remember(const RoadBorder& border, const Pose2& base_in_map, Side& side) const;

  RoadExtensionOptions options_;
  std::array<Side, 2> sides_;
};

}  // namespace datmo
