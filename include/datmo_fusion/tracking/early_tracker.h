// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <deque>
#include <optional>

#include "datmo_fusion/common/object.h"
#include "datmo_fusion/common/pose2.h"
#include "datmo_fusion/common/scan.h"
#include "datmo_fusion/tracking/track.h"
#include "datmo_fusion/tracking/tracker.h"
#include "datmo_fusion/visibility/visibility.h"

namespace datmo {

/// The input of a tracker at one time (Tracker::process).
struct TrackerInput {
  ObjectList objects;
  Pose2 base_in_fixed;
  Visibility visibility;
};

/// A tracker that does not wait for its slower sensors. Objects of one time may come twice: early,
/// with what is available at once, and later complete, with what arrived late.
///
/// Late objects are not fused into a later state as out-of-sequence measurements (Bar-Shalom,
/// Update with out-of-sequence measurements in tracking, 2002), which with several hypotheses would
/// be an approximation; their time is processed again. There are two trackers: one gets only the
/// complete lists, and its state is the same as if there had been no early ones, bit for bit except
/// for ids; the other is a copy of it that has continued with the newer early lists. When a
/// complete list arrives, these are run again from there, so that the next early list builds on it.
///
/// Tracks that early lists confirm are published; whether they stay is decided by complete lists.
/// From then on, the target keeps that id, also in complete lists, and no other target gets it:
/// only the ids differ from a tracker without early lists. Targets that early lists start are not
/// confirmed before a complete list contains them: until then, nothing shows that they are the same
/// targets after the lists were run again.
///
/// Not thread-safe; early and complete lists each in ascending stamp order.
class EarlyTracker {
 public:
  /// As Tracker. Throws OptionError.
  explicit EarlyTracker(const Checked<TrackerOptions>& options, StepClock clock = {})
      : complete_(options, std::move(clock)) {}

  /// As Tracker's.
  void setOptions(const Checked<TrackerOptions>& options);
  void addScan(const LabeledScan& scan);
  void addClasses(const ObjectList& classes);

  /// Processes a complete list and returns the tracks by all complete lists; early lists only
  /// affect their ids.
  TrackList process(const TrackerInput& complete);

  /// Processes an early list, newer than all complete ones; returns the tracks by all lists.
  TrackList processEarly(TrackerInput early);

  /// Returns counts: confirmed, merged and evicted are those of the complete lists; left out or cut
  /// short are those of all lists, counting early ones each time that they were run.
  TrackerCounts counts() const;

  /// Returns the number of early lists that wait for their complete ones; if too many, the oldest
  /// is dropped.
  std::size_t waiting() const { return waiting_.size(); }

  /// As Tracker's.
  void reset();

 private:
  TrackList goOn(const TrackerInput& early);
  void runAgain();

  Tracker complete_;
  std::optional<Tracker> ahead_;      ///< none: the same as complete_
  std::deque<TrackerInput> waiting_;  ///< what it has processed, newer than the last complete list
  TrackerCounts early_effort_;        ///< of early lists: left out or cut short
};

}  // namespace datmo
