// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "datmo_fusion/ros/convert/messages.h"
#include "datmo_fusion/ros/display/scan_views.h"
#include "datmo_fusion/ros/frame_options.h"
#include "datmo_fusion/ros/stage/stage.h"
#include "datmo_fusion/ros/stage/stage_runner.h"
#include "datmo_fusion/ros/transform_buffer.h"
#include "datmo_fusion/tracking/early_tracker.h"

namespace datmo {

struct TrackerStageOptions {
  FrameOptions frames;          ///< of all stages
  double transform_wait = 0.3;  ///< s
  bool scan_view = true;
  StreamOptions input;
  TrackerOptions tracker;

  void visit(OptionVisitor& visitor);
};

/// Tracker between messages: the same one serves the nodelet and the bag runner.
///
/// Objects wait in a bounded queue until the vehicle's pose at their stamp is known, from the split
/// scan in which they were found, or else from tf; nothing blocks. Bad input is dropped through the
/// monitor, never thrown. When the clock jumps back all tracks are forgotten.
///
/// Tracks of a time come out once: of early objects, if there are any, at once, and what the
/// complete ones of that time add is in the next tracks (EarlyTracker).
class TrackerStage : public Stage {
 public:
  using Options = TrackerStageOptions;

  /// `transforms` and `monitor` must outlive the stage. With a clock the tracker keeps to its time
  /// budget; without one its output depends on nothing but its input. Throws OptionError.
  TrackerStage(const Checked<TrackerStageOptions>& options, const TransformBuffer& transforms,
               StageMonitor& monitor, StepClock clock = {});

  /// Where the vehicle was at this scan, and (`scan_view`) what it saw. It may come before or after
  /// the scan's objects.
  void takeLabeledScan(const LabeledScanMessage& message);

  /// Puts objects into the queue. `now`: ROS time.
  void takeObjects(const ObjectArrayConstPtr& message, Stamp now) {
    enqueue({message, now, false});
  }

  /// The same with those that are not complete: all objects of that time are still to come.
  void takeEarlyObjects(const ObjectArrayConstPtr& message, Stamp now) {
    enqueue({message, now, true});
  }

  /// The tracks at the stamp of the next objects in the queue whose pose is known; null if there
  /// are none. Objects that have waited for longer than transform_wait are dropped. To be called
  /// until null, after each new input and after new transforms.
  TrackArrayPtr next(Stamp now);

  void connect(StagePorts& ports) override;
  std::vector<LiveOption> live() const override { return liveOptions(options_); }
  void change(const OptionValues& values) override;
  bool publishNext(Stamp now) override;
  double maxWait() const override { return options_.transform_wait; }

 private:
  struct Waiting {
    ObjectArrayConstPtr objects;
    Stamp since;
    bool early = false;
  };

  void enqueue(const Waiting& waiting);

  void reset();

  /// Throws InputError (`missing_transform`).
  Pose2 baseInFixed(const std_msgs::Header& base) const;
  bool knowsPose(const std_msgs::Header& base) const;

  /// Null if there are tracks of that time already. Throws InputError.
  TrackArrayPtr track(const Waiting& waiting);
  TrackArrayPtr messageOf(const TrackList& list);
  void report(const TrackerCounts& before, const TrackerCounts& after);
  bool hasWaitedTooLong(const Waiting& waiting, Stamp now) const;

  TrackerStageOptions options_;
  const TransformBuffer& transforms_;
  StageMonitor& monitor_;
  EarlyTracker tracker_;
  StageRunner runner_;
  ScanViews scan_views_;
  std::deque<Waiting> queue_;
  std::optional<Stamp> published_;    ///< of the last tracks
  double unpublished_seconds_ = 0.0;  ///< spent since then on what led to no message
  StagePublisher<TrackArray> tracks_;
};

}  // namespace datmo
