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
#include "datmo_fusion/tracking/late_classes.h"
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
  LateClassCounts classes;
  std::uint64_t confirmed_tracks = 0;
  std::uint64_t merged_tracks = 0;    ///< removed as duplicates of a confirmed track
  std::uint64_t evicted_targets = 0;  ///< unconfirmed, removed to make room for new objects
};

/// Tracks moving objects over time (thesis 3.3.4).
///
/// Every object that is not known to be static starts a target, which is followed internally, in
/// several hypotheses; confirmed targets of the most likely one are published. They have been
/// detected several times, surely move or have moved (motionProbability), and are likely enough to
/// exist. Without detections, a track lives as long as it was followed with them, up to a limit,
/// and as long as it is not missed where it should be detected.
///
/// Not thread-safe; lists in ascending stamp order, which the caller ensures (StampGate). The order
/// of the objects in a list does not matter.
class Tracker {
 public:
  /// Throws OptionError. With a clock, a step keeps its time budget by following fewer hypotheses;
  /// without one, the same input gives the same output on every machine.
  explicit Tracker(const Checked<TrackerOptions>& options, StepClock clock = {});

  /// Changes live options (Tier::kLive); all others must stay as they were.
  void setOptions(const Checked<TrackerOptions>& options);

  /// Adds the beams of a scan, in ascending stamp order: evidence of motion
  /// (MotionLikelihoodOptions). Without scans, only the objects' velocities are.
  void addScan(const LabeledScan& scan);

  /// Processes the objects of one time, in the vehicle's frame; takes the vehicle's pose in the
  /// fixed frame and what the sensors could have seen (base frame) at that time. Returns the
  /// confirmed tracks and the sensors' views in the fixed frame at that time.
  TrackList process(const ObjectList& objects, const Pose2& base_in_fixed,
                    const Visibility& visibility);

  /// The same if nothing is known about what the sensors could have seen.
  TrackList process(const ObjectList& objects, const Pose2& base_in_fixed);

  /// Adds the classes of a list's objects, which arrive after that list was processed, or before:
  /// the objects of the scanner's list of that stamp, in the vehicle's frame, with their classes.
  /// Each counts for the target of its object (LateClasses), at once or with that list.
  void addClasses(ObjectList classes);

  const TrackerCounts& counts() const { return counts_; }

  /// Returns a copy that continues from the same state with incomplete lists (EarlyTracker). It
  /// only confirms targets that it has in common with this tracker: those that it starts itself are
  /// not certain to be the same ones here.
  Tracker ahead() const;

  /// Reserves for targets, confirmed here or not, the ids under which such a copy, made since the
  /// last step, has confirmed them; no other target gets these ids.
  void keepIds(const Tracker& ahead);

  /// Removes all tracks; ids continue, so that none is reused.
  void reset();

 private:
  void removeDuplicates();
  /// `numbers`: ascending.
  void remove(const std::vector<std::uint64_t>& numbers);

  /// Evicts old false alarms, so that new objects are never refused because of them.
  void makeRoom(std::size_t objects, double seconds);
  void removeLost();

  /// How long a track that was followed for this time may go undetected.
  double silenceAfter(double followed, double max) const;
  bool isLost(const Target& target) const;
  double existence(const Target& target) const;
  bool isPublished(const BestTarget& best) const;
  void confirm();

  /// With the required probability, as far as is known.
  bool isLikelyMoving(const Target& target) const;
  bool isConfirmable(const Target& target) const;

  void updateClasses();

  /// Objects of confirmed targets are not clutter.
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
  LateClasses late_classes_;
  TrackPaths paths_;
  std::optional<Stamp> stamp_;
  std::uint32_t next_id_ = 1;
  std::uint64_t confirmable_ =
      std::numeric_limits<std::uint64_t>::max();  ///< numbers below this may be confirmed
  TrackerCounts counts_;
};

}  // namespace datmo
