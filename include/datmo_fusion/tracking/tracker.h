// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "datmo_fusion/common/copied_ptr.h"
#include "datmo_fusion/common/object.h"
#include "datmo_fusion/common/scan.h"
#include "datmo_fusion/tracking/association_scan.h"
#include "datmo_fusion/tracking/clutter_map.h"
#include "datmo_fusion/tracking/step_budget.h"
#include "datmo_fusion/tracking/target_set.h"
#include "datmo_fusion/tracking/track.h"
#include "datmo_fusion/tracking/track_paths.h"
#include "datmo_fusion/tracking/tracker_options.h"
#include "datmo_fusion/tracking/transition_model.h"
#include "datmo_fusion/visibility/scan_history.h"
#include "datmo_fusion/visibility/visibility.h"

namespace datmo {

/// Counts since construction or reset(), for diagnostics.
struct TrackerCounts {
  ScanIntakeCounts intake;
  AssociationCounts association;
  std::uint64_t confirmed_tracks = 0;
  std::uint64_t merged_tracks = 0;    ///< removed as another view of a confirmed track
  std::uint64_t evicted_targets = 0;  ///< unconfirmed ones that made room for new objects
};

/// Follows moving objects over time (thesis 3.3.4).
///
/// Every object that is not known as static starts a target, which is followed inside, in several
/// hypotheses; what is published are confirmed targets of the most likely one. They have been seen
/// several times, surely move or have moved (motionProbability), and are likely enough to exist. A
/// track lives without objects for as long as it was followed with them, up to a limit, and as long
/// as it is not missed where it should be seen.
///
/// Not thread safe; lists in rising stamp order, which the caller ensures (StampGate). The order of
/// the objects in a list does not matter.
class Tracker {
 public:
  /// Throws OptionError. With a clock, a step keeps to its time budget by following fewer
  /// hypotheses; without one, the same input gives the same output on every machine.
  explicit Tracker(const Checked<TrackerOptions>& options, StepClock clock = {});

  /// Goes on with other live options (Tier::kLive); all others must be as they were.
  void setOptions(const Checked<TrackerOptions>& options);

  /// Takes the beams of a scan, by rising stamps: evidence of what moves (MotionLikelihoodOptions).
  /// Without them the velocities of its objects alone are.
  void addScan(const LabeledScan& scan);

  /// Takes the objects of one time, in the vehicle's frame, the vehicle's pose in the fixed frame
  /// at that time, and what the sensors could have seen then (base frame). Returns the confirmed
  /// tracks and the sensors' views in the fixed frame at that time.
  TrackList process(const ObjectList& objects, const Pose2& base_in_fixed,
                    const Visibility& visibility);

  /// The same when nothing is known of what the sensors could have seen.
  TrackList process(const ObjectList& objects, const Pose2& base_in_fixed);

  const TrackerCounts& counts() const { return counts_; }

  /// A copy, to go on by itself from the same state with what this one will get completed
  /// (EarlyTracker). Of those that it follows it confirms only targets of this one: what it starts
  /// itself is not certain to be the same one here.
  Tracker ahead() const;

  /// Targets have the ids that such a copy, made since the last step, has confirmed them under,
  /// whether they are confirmed here or not; no other gets them.
  void keepIds(const Tracker& ahead);

  /// Forgets all tracks; ids go on, so that none is reused.
  void reset();

 private:
  void removeDuplicates();
  /// `numbers`: rising.
  void remove(const std::vector<std::uint64_t>& numbers);

  /// So that new objects are never refused for the sake of old false alarms.
  void makeRoom(std::size_t objects, double seconds);
  void removeLost();

  /// How long a track that was followed for this time may go unseen.
  double silenceAfter(double followed, double max) const;
  bool isLost(const Target& target) const;
  double existence(const Target& target) const;
  bool isPublished(const BestTarget& best) const;
  void confirm();

  /// With the required probability, as far as is known.
  bool isLikelyMoving(const Target& target) const;
  bool isConfirmable(const Target& target) const;

  /// What belongs to a confirmed target is no clutter.
  void learnClutter(const AssociationScan& scan, double seconds);
  TrackList published(Stamp stamp, const AssociationScan& scan);
  Track trackOf(const BestTarget& best, const AssociationScan& scan) const;

  TrackerOptions options_;
  StepClock clock_;
  Visibility unknown_view_;
  ClutterMap clutter_;
  TransitionPriors transition_priors_;
  ScanHistory scans_;
  CopiedPtr<TargetSet> targets_;
  TrackPaths paths_;
  std::optional<Stamp> stamp_;
  std::uint32_t next_id_ = 1;
  std::uint64_t confirmable_ = std::numeric_limits<std::uint64_t>::max();  ///< lower numbers are
  TrackerCounts counts_;
};

}  // namespace datmo
