// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>

#include "datmo_fusion/common/object.h"
#include "datmo_fusion/common/scan.h"
#include "datmo_fusion/tracking/step_budget.h"
#include "datmo_fusion/tracking/target_set.h"
#include "datmo_fusion/tracking/track.h"
#include "datmo_fusion/tracking/tracker_options.h"
#include "datmo_fusion/visibility/visibility.h"

namespace datmo {

/// Counts since construction or reset(), for diagnostics.
struct TrackerCounts {
  ScanIntakeCounts intake;
  AssociationCounts association;
  std::uint64_t confirmed_tracks = 0;  ///< ids given out
  std::uint64_t merged_tracks = 0;     ///< removed as another view of a confirmed track
  std::uint64_t evicted_targets = 0;   ///< unconfirmed ones that made room for new objects
};

/// Follows moving objects over time (thesis 3.3.4).
///
/// Every object that is not known as static starts a target, which is followed inside, in several
/// hypotheses; what is published are confirmed targets of the most likely one. They have been seen
/// several times, evidently move or have moved (MotionEvidence), and are likely enough to exist. A
/// track lives without objects for as long as it was followed with them, up to a limit, and as long
/// as it is not missed where it should be seen.
///
/// Not thread safe; lists in rising stamp order, which the caller ensures (StampGate). The order of
/// the objects in a list does not matter.
class Tracker {
 public:
  /// Throws OptionError. With a clock, a step keeps to its time budget by following fewer
  /// hypotheses; without one, the same input gives the same output on every machine.
  explicit Tracker(const TrackerOptions& options, StepClock clock = {});
  ~Tracker();

  /// Goes on with other live options (Tier::kLive); all others must be as they were.
  void setOptions(const TrackerOptions& options);

  /// Takes the beams of a scan, by rising stamps: they tell what moves (MotionLikelihoodOptions).
  /// Without them its objects alone do (MotionEvidence).
  void addScan(const LabeledScan& scan);

  /// Takes the objects of one time, in the vehicle's frame, the vehicle's pose in the fixed frame
  /// at that time, and what the sensors could have seen then (base frame). Returns the confirmed
  /// tracks and the sensors' views in the fixed frame at that time.
  TrackList process(const ObjectList& objects, const Pose2& base_in_fixed,
                    const Visibility& visibility);

  /// The same when nothing is known of what the sensors could have seen.
  TrackList process(const ObjectList& objects, const Pose2& base_in_fixed);

  const TrackerCounts& counts() const;

  /// Forgets all tracks; ids go on, so that none is reused.
  void reset();

 private:
  class State;
  std::unique_ptr<State> state_;
};

}  // namespace datmo
