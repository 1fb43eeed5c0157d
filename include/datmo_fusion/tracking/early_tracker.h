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
/// alone, and is at each of them as if there had been no early ones, bit for bit; and a copy of it
/// that has gone on with the early lists that are newer. When a complete list comes they are run
/// again from there, so that the next early one finds it considered.
///
/// What early lists confirm is published; whether it stays, and under which id, complete lists say.
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

  /// The tracks by a complete list and those before, and by nothing else.
  TrackList process(const TrackerInput& complete);

  /// The tracks by an early list, newer than all complete ones, and all before.
  TrackList processEarly(TrackerInput early);

  /// Of the complete lists.
  const TrackerCounts& counts() const { return complete_.counts(); }

  /// Early lists that wait for the complete ones of their time; bounded, the oldest gives way.
  std::size_t waiting() const { return waiting_.size(); }

  /// As Tracker's.
  void reset();

 private:
  void runAgain();

  Tracker complete_;
  std::optional<Tracker> ahead_;      ///< none: as complete_
  std::deque<TrackerInput> waiting_;  ///< what it went on with, newer than the last complete list
};

}  // namespace datmo
