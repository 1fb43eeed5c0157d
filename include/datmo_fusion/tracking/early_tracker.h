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

/// What a tracker takes of one time (Tracker::process).
struct TrackerInput {
  ObjectList objects;
  Pose2 base_in_fixed;
  Visibility visibility;
};

/// A tracker that does not wait for the slower one of its sensors. Objects of one time may come
/// twice: early, with what is known at once, and later complete, with what came late.
///
/// What is late is no measurement out of sequence to be fitted into a later state (Bar-Shalom,
/// Update with out-of-sequence measurements in tracking, 2002), which with several hypotheses would
/// be an approximation: its time is done again. There are a tracker that gets the complete lists
/// alone, and is at each of them as if there had been no early ones, bit for bit but for ids; and a
/// copy of it that has gone on with the early lists that are newer. When a complete list comes they
/// are run again from there, so that the next early one finds it considered.
///
/// What early lists confirm is published; whether it stays, complete lists say. Its id is the
/// target's from then on, of complete lists too, and of no other: so those alone differ from what
/// they would be without early lists. What early lists start is confirmed no sooner than a complete
/// one has it: until then nothing tells that it is the same target after they were run again.
///
/// Not thread safe; early and complete lists each by rising stamps.
class EarlyTracker {
 public:
  /// Throws OptionError. As Tracker.
  explicit EarlyTracker(const Checked<TrackerOptions>& options, StepClock clock = {})
      : complete_(options, std::move(clock)) {}

  /// As Tracker's.
  void setOptions(const Checked<TrackerOptions>& options);
  void addScan(const LabeledScan& scan);

  /// The tracks by a complete list and those before; by early ones, their ids.
  TrackList process(const TrackerInput& complete);

  /// The tracks by an early list, newer than all complete ones, and all before.
  TrackList processEarly(TrackerInput early);

  /// What was confirmed, merged and evicted by the complete lists, and what was left out or cut
  /// short of all, of the early ones each time that they were run.
  TrackerCounts counts() const;

  /// Early lists that wait for the complete ones of their time; bounded, the oldest gives way.
  std::size_t waiting() const { return waiting_.size(); }

  /// As Tracker's.
  void reset();

 private:
  TrackList goOn(const TrackerInput& early);
  void runAgain();

  Tracker complete_;
  std::optional<Tracker> ahead_;      ///< none: as complete_
  std::deque<TrackerInput> waiting_;  ///< what it went on with, newer than the last complete list
  TrackerCounts early_effort_;        ///< of early lists, what was left out or cut short
};

}  // namespace datmo
