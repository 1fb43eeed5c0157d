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

/// Border probability along the vehicle's path, from the evidence of the followed lines. Stations
/// behind keep the values they had when the vehicle passed: a turn does not change the road before
/// it.
class PresenceHistory {
 public:
  explicit PresenceHistory(const PresenceHistoryOptions& options);

  const BorderPresence& presence() const { return presence_; }

  /// Updates with the current lines, `seconds` after the last call.
  void update(const std::vector<FollowedBorder>& borders, const Pose2& base_in_map, double seconds);

  /// Forgets everything, as after construction.
  void reset();

 private:
  void moveTo(const Pose2& base_in_map);
  void shift(SidePresence& side) const;
  void update(const std::vector<FollowedBorder>& borders, RoadSide which, double seconds,
              SidePresence& side);

  PresenceHistoryOptions options_;
  BorderPresence presence_;
  std::optional<Pose2> vehicle_;  ///< map frame
  std::optional<Pose2> counted_;  ///< map frame, pose up to which the distance is counted
  std::vector<std::optional<double>> updated_;  ///< log odds of one side's stations, from this scan
};

}  // namespace datmo
