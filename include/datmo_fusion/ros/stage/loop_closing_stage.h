// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <datmo_fusion/SaveMap.h>
#include <tf2_msgs/TFMessage.h>

#include <nav_msgs/OccupancyGrid.h>
#include <nav_msgs/Path.h>

#include "datmo_fusion/ros/convert/messages.h"
#include "datmo_fusion/ros/frame_options.h"
#include "datmo_fusion/ros/shared_keys.h"
#include "datmo_fusion/ros/stage/loop_closing_work.h"
#include "datmo_fusion/ros/stage/newest_worker.h"
#include "datmo_fusion/ros/stage/stage.h"
#include "datmo_fusion/ros/stage/stage_runner.h"
#include "datmo_fusion/slam/gradual_correction.h"
#include "datmo_fusion/tracking/step_budget.h"

namespace datmo {

struct LoopClosingStageOptions {
  FrameOptions frames;  ///< of all stages
  std::string global_frame = "global_map";
  double publish_period = 10.0;  ///< s
  double publish_share = 0.05;   ///< of the drive's time
  KeyframeOptions keyframes;
  GradualCorrectionOptions correction;
  LoopCloserOptions loops;
  StreamOptions input;

  void visit(OptionVisitor& visitor);
  static SharedKeys sharedKeys();
};

/// The optimized drive, in the global frame.
struct OptimizedDrive {
  nav_msgs::PathConstPtr trajectory;
  nav_msgs::OccupancyGridConstPtr map;  ///< null if it is too wide for one
};

/// LoopCloser between messages. The same stage serves the nodelet, where loops are searched and
/// closed in a thread of their own, and the bag runner, where each scan is done with when it comes.
///
/// The live map, its frame and all that is tracked in it stay as they are: `map` is the child of no
/// other frame than before. Where it lies in the optimized drive is published as its child,
/// `map` -> `global_map`, and moves there gradually.
///
/// A clock that jumps back, and a SLAM that begins a new map or finds itself in a prior one
/// (KeyframeSelector), begin a new trajectory, and the old one is forgotten.
///
/// Bad input is dropped through the monitor, never thrown: what fromMessage refuses, stamps out of
/// order, and `superseded_scan` (the thread has too many to do).
class LoopClosingStage : public Stage {
 public:
  using Options = LoopClosingStageOptions;

  /// `clock`: none: without a thread, and the output depends on nothing but the input. `monitor`
  /// must outlive the stage. Throws OptionError.
  LoopClosingStage(const Checked<LoopClosingStageOptions>& options, StageMonitor& monitor,
                   const StepClock& clock = {});

  /// map -> global_map at the scan's stamp; null if the scan was dropped.
  tf2_msgs::TFMessageConstPtr takeLabeledScan(const LabeledScanMessage& message, Stamp now);

  /// The optimized drive if it has changed and is due; none otherwise. To be called from time to
  /// time. `now`: ROS time.
  std::optional<OptimizedDrive> next(Stamp now);

  /// Writes the map that was put out last (writeMap). Returns a sentence on what was written.
  /// Throws MapFileError, also if there is none yet.
  std::string saveMap(const std::string& file) const;

  /// What became of the searches for loops in the drive that was put out last, and its loops.
  const LoopCounts& counts() const { return counts_; }
  const std::vector<ClosedLoop>& loops() const { return loops_; }

  /// Blocks until the thread has nothing to do: for tests.
  void waitUntilIdle() { worker_.waitUntilIdle(); }

  void connect(StagePorts& ports) override;
  bool publishNext(Stamp now) override;
  double maxWait() const override;

 private:
  void beginDrive(Stamp stamp);
  void queue(LoopJob::Step step);
  /// Gives the thread what has come, unless it has something to do.
  void startIfIdle(Stamp now);
  void takeResults();
  void show(const LoopResult& result);
  tf2_msgs::TFMessageConstPtr transformAt(Stamp stamp, const Pose2& base_in_map);
  std::vector<LoopJob::Step> takeWaiting();
  OptimizedDrive driveOf(const LoopResult& result) const;

  LoopClosingStageOptions options_;
  StageMonitor& monitor_;
  StageRunner runner_;
  KeyframeSelector selector_;
  GradualCorrection correction_;
  Pose2 map_in_global_;  ///< to which the correction leads
  std::vector<LoopJob::Step> waiting_;
  bool is_busy_ = false;
  std::uint64_t drive_ = 0;       ///< counts the trajectories
  Stamp begun_;                   ///< the drive
  Stamp last_;                    ///< scan
  std::optional<Stamp> changed_;  ///< ROS time since when the drive put out last is old
  std::optional<OptimizedDrive> due_;
  LoopCounts counts_;
  std::vector<ClosedLoop> loops_;
  std::shared_ptr<const OccupancyMap> map_;
  std::unique_ptr<LoopCloser> closer_;
  NewestWorker<LoopJob, LoopResult> worker_;  ///< last: its thread uses the closer
  StagePublisher<nav_msgs::Path> trajectories_;
  StagePublisher<nav_msgs::OccupancyGrid> maps_;
};

}  // namespace datmo
