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
  FrameOptions frames;  ///< shared by all stages
  std::string global_frame = "global_map";
  double publish_period = 10.0;  ///< s
  /// 0 to 1: minimum time between two optimized maps, as a share of the time driven: the map of a
  /// longer drive takes longer to draw
  double publish_share = 0.05;
  KeyframeOptions keyframes;
  GradualCorrectionOptions correction;
  LoopCloserOptions loops;
  StreamOptions input;

  void visit(OptionVisitor& visitor);
  static SharedKeys sharedKeys();
};

/// The optimized trajectory and its map, in the global frame.
struct OptimizedDrive {
  nav_msgs::PathConstPtr trajectory;
  nav_msgs::OccupancyGridConstPtr map;  ///< null if it is too large for one
};

/// Runs LoopCloser on messages. The nodelet searches for and closes loops in a separate thread; the
/// bag runner processes each scan synchronously.
///
/// The live map, its frame and all tracks in it remain unchanged: `map` keeps its parent frame. Its
/// pose in the optimized drive is published as a child frame, `map` -> `global_map`, which moves
/// gradually.
///
/// A new trajectory begins, and the old one is forgotten, when the clock jumps and when SLAM
/// begins a new map or locates itself in a prior one (KeyframeSelector).
///
/// Bad input is dropped and reported to the monitor, never thrown: what fromMessage rejects, stamps
/// out of order, and `superseded_scan` (the thread is overloaded).
class LoopClosingStage : public Stage {
 public:
  using Options = LoopClosingStageOptions;

  /// `clock`: none: no thread, and the output depends on the input alone. `monitor` must outlive
  /// the stage. Throws OptionError.
  LoopClosingStage(const Checked<LoopClosingStageOptions>& options, StageMonitor& monitor,
                   const StepClock& clock = {});

  /// Returns map -> global_map at the scan's stamp; null if the scan was dropped.
  tf2_msgs::TFMessageConstPtr handleLabeledScan(const LabeledScanMessage& message, Stamp now);

  /// Returns the optimized drive if it has changed and is due; none otherwise. Call it
  /// periodically. `now`: ROS time.
  std::optional<OptimizedDrive> next(Stamp now);

  /// Writes the last published map (writeMap). Returns a sentence about what was written. Throws
  /// MapFileError, also if there is none yet.
  std::string saveMap(const std::string& file) const;

  /// Results of the loop searches in the last published drive, and its loops.
  const LoopCounts& counts() const { return counts_; }
  const std::vector<ClosedLoop>& loops() const { return loops_; }

  /// Blocks until the thread is idle; for tests.
  void waitUntilIdle() { worker_.waitUntilIdle(); }

  void connect(StagePorts& ports) override;
  bool publishNext(Stamp now) override;
  double maxWait() const override;

 private:
  void beginDrive(Stamp stamp);
  void queue(LoopJob::Step step);
  /// Passes the received scans to the thread unless it is busy.
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
  Pose2 map_in_global_;  ///< target of the gradual correction
  std::vector<LoopJob::Step> waiting_;
  bool is_busy_ = false;
  std::uint64_t drive_ = 0;       ///< counter of trajectories
  Stamp begun_;                   ///< stamp of the drive's begin
  Stamp last_;                    ///< stamp of the last scan
  std::optional<Stamp> changed_;  ///< ROS time since when the last published drive is outdated
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
