#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "datmo_fusion/common/object.h"
#include "datmo_fusion/common/options.h"
#include "datmo_fusion/tracking/association.h"
#include "datmo_fusion/tracking/clutter_map.h"
#include "datmo_fusion/tracking/duplicates.h"
#include "datmo_fusion/tracking/hypothesis_growth.h"
#include "datmo_fusion/tracking/split_merge.h"
#include "datmo_fusion/tracking/step_budget.h"
#include "datmo_fusion/tracking/target.h"
#include "datmo_fusion/tracking/target_set.h"
#include "datmo_fusion/tracking/track.h"
#include "datmo_fusion/tracking/visibility.h"

namespace datmo {

struct TrackerOptions {
  std::string association = "mht";
  HypothesisOptions hypotheses;
  SplitMergeOptions split_merge;
  ScanIntakeOptions intake;
  AssociationOptions gating;
  ClutterMapOptions clutter;
  VisibilityOptions visibility;
  TargetOptions target;
  DuplicateOptions duplicates;
  bool require_motion = true;
  int confirmation_hits = 3;
  int fused_confirmation_hits = 1;
  double confirmation_existence = 0.5;  ///< 1
  double least_existence = 0.25;        ///< 1
  double published_existence = 0.5;     ///< 1
  double tentative_silence = 0.5;       ///< s
  double confirmed_silence = 3.0;       ///< s
  double published_silence = 1.5;       ///< s
  double most_position_std = 5.0;       ///< m
  double history_time = 3.0;            ///< s
  double time_budget = 0.03;            ///< s

  void visit(OptionVisitor& visitor);
};

/// Counts since construction or reset(), for diagnostics.
struct TrackerCounts {
  ScanIntakeCounts intake;
  AssociationCounts association;
  std::uint64_t confirmed_tracks = 0;  ///< ids given out
  std::uint64_t merged_tracks = 0;     ///< removed as another view of a confirmed track
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

  /// Takes the objects of one time, in the vehicle's frame, the vehicle's pose in the fixed frame
  /// at that time, and what the sensors could have seen then. Returns the confirmed tracks in the
  /// fixed frame at that time.
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
