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
  FrameOptions frames;          ///< shared by all stages
  double transform_wait = 0.3;  ///< s
  bool scan_view = true;
  StreamOptions input;
  TrackerOptions tracker;

  void visit(OptionVisitor& visitor);
};

/// Runs Tracker on messages, for both the nodelet and the bag runner.
///
/// Objects wait in a bounded queue until the vehicle's pose at their stamp is known, from the
/// labeled scan in which they were detected, or else from tf; nothing blocks. Bad input is dropped
/// and reported to the monitor, never thrown. All tracks are forgotten when the clock jumps.
///
/// Tracks of a stamp are published once: from the early objects, if any, at once; what the complete
/// objects of that stamp add is included in the next tracks (EarlyTracker).
class TrackerStage : public Stage {
 public:
  using Options = TrackerStageOptions;

  /// `transforms` and `monitor` must outlive the stage. With a clock the tracker respects its time
  /// budget; without one its output depends on its input alone. Throws OptionError.
  TrackerStage(const Checked<TrackerStageOptions>& options, const TransformBuffer& transforms,
               StageMonitor& monitor, StepClock clock = {});

  /// Sets the vehicle's pose at this scan and, with `scan_view`, what the scanner saw. It may be
  /// received before or after the scan's objects.
  void handleLabeledScan(const LabeledScanMessage& message);

  /// Adds objects to the queue. `now`: ROS time.
  void handleObjects(const ObjectArrayConstPtr& message, Stamp now) {
    enqueue({message, now, false});
  }

  /// The same for incomplete objects: the complete ones of that stamp follow.
  void handleEarlyObjects(const ObjectArrayConstPtr& message, Stamp now) {
    enqueue({message, now, true});
  }

  /// Adds the classes of the scanner's objects at an earlier stamp, or one that is yet to come.
  void handleClasses(const ObjectArray& message);

  /// Returns the tracks at the stamp of the next objects in the queue with a known pose; null if
  /// there are none. Objects that have waited longer than transform_wait are dropped. Call it until
  /// null, after each new input and after new transforms.
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

  /// Null if tracks of that stamp were already published. Throws InputError.
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
  double unpublished_seconds_ = 0.0;  ///< time spent since then on input that yielded no message
  StagePublisher<TrackArray> tracks_;
};

}  // namespace datmo
