// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/common/pose2.h"
#include "datmo_fusion/road/border_presence.h"
#include "datmo_fusion/road/followed_border.h"

namespace datmo {

struct PresenceHistoryOptions {
  double ahead = 40.0;   ///< m
  double behind = 10.0;  ///< m

  void visit(OptionVisitor& visitor);
};

/// Where along the vehicle's path there are borders, by the evidence of the followed lines. What
/// lies behind stays as it was when the vehicle passed it: a turn does not change the road before
/// it.
class PresenceHistory {
 public:
  explicit PresenceHistory(const PresenceHistoryOptions& options);

  const BorderPresence& presence() const { return presence_; }

  /// Takes in the lines as they are now, `seconds` after the last time.
  void update(const std::vector<FollowedBorder>& borders, const Pose2& base_in_map, double seconds);

  /// Forgets all, as at the start.
  void reset();

 private:
  void moveTo(const Pose2& base_in_map);
  void shift(SidePresence& side) const;
  void take(const std::vector<FollowedBorder>& borders, RoadSide which, double seconds,
            SidePresence& side);

  PresenceHistoryOptions options_;
  BorderPresence presence_;
  std::optional<Pose2> vehicle_;                ///< map frame
  std::optional<Pose2> counted_;                ///< map frame, up to where the distance is counted
  std::vector<std::optional<double>> updated_;  ///< log odds of one side's stations, by this scan
};

}  // namespace datmo
