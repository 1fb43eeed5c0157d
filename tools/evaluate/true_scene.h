// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <set>
#include <vector>

#include "evaluate/recorded_data.h"
#include "evaluate/score_options.h"
#include "evaluate/trajectory.h"

namespace datmo::evaluation {

/// The ground truth at any stamp of a recording, and which of its objects have to be found.
///
/// Objects that never move in the whole recording (parked cars, poles) are kept separately:
/// reporting them as moving is an error. Those that are stationary for a while need not be found.
class TrueScene {
 public:
  TrueScene(const RecordedTruth& truth, const ScoreOptions& options);

  struct View {
    Pose2 base_in_map;               ///< of the true vehicle
    std::vector<TrueState> objects;  ///< that move at some time
  };

  /// Objects are interpolated between their two neighboring stamps; their visibility is that of the
  /// nearer one. An object that exists at only one neighbor is extrapolated with its velocity.
  /// Returns none outside the recording, and in a gap of it.
  std::optional<View> at(Stamp stamp) const;

  /// The objects that never move, but would have to be found if they did. Interpolated as above.
  std::vector<TrueState> standingAt(Stamp stamp) const;

  /// Whether a point (m, map) is in the region that is scored.
  bool isInRegion(const Pose2& base_in_map, const Point2& point) const;

  /// Pose of the vehicle over time.
  const Trajectory& trajectory() const { return trajectory_; }

  /// Stamps with objects, rising.
  const std::vector<Stamp>& stamps() const { return stamps_; }

 private:
  Duty dutyOf(const RecordedObject& object, const Pose2& base_in_map) const;
  bool isWanted(const RecordedObject& object, const Pose2& base_in_map) const;
  bool isSeen(const RecordedObject& object) const;
  bool isWantedClass(ObjectClass classification) const;

  ScoreOptions options_;
  Trajectory trajectory_;
  std::vector<RecordedObjects> movers_;    ///< those that move at one stamp at least
  std::vector<RecordedObjects> standing_;  ///< the others, at the same stamps
  std::vector<Stamp> stamps_;
};

}  // namespace datmo::evaluation
