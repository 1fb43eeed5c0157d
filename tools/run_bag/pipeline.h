#pragma once

#include <array>
#include <optional>
#include <vector>

#include "last_stage.h"
#include "pipeline_options.h"
#include "stage_times.h"
#include <tf2_msgs/TFMessage.h>

#include "datmo_fusion/ros/stage_monitor.h"
#include "datmo_fusion/ros/transform_buffer.h"

namespace datmo {

/// The stages of perception.launch, wired without a master:
///
///     scan, odometry, tf ─► grid_slam ─ split scan ─► moving_objects ─ objects ─► tracker ─ tracks
///                               └───────── split scan, map -> odom ──────────────────┘
///
/// Messages go in one after the other, as they came; the same messages give the same results, bit
/// for bit.
class Pipeline {
 public:
  /// `last`: the stages after it are left out. Throws OptionError.
  explicit Pipeline(const PipelineOptions& options, LastStage last = LastStage::kTracker);

  /// What one message led to, in the order in which it came to be.
  struct Output {
    std::optional<GridSlamOutput> slam;
    ObjectArrayPtr objects;
    std::vector<TrackArrayPtr> tracks;
    nav_msgs::OccupancyGridPtr map;  ///< null if it is not its turn
  };

  void takeStaticTransforms(const tf2_msgs::TFMessage& message);

  /// Objects may have waited for a transform, so that there may be tracks. What grid_slam
  /// publishes itself is left out: a bag of an earlier run may hold it.
  Output takeTransforms(const tf2_msgs::TFMessage& message, Stamp now);

  void takeOdometry(const nav_msgs::Odometry& message);

  /// `Message`: sensor_msgs::LaserScan or MultiEchoLaserScan. `now`: when it came.
  template <typename Message>
  Output takeScan(const Message& message, Stamp now) {
    Output output;
    output.slam = slam_.takeScan(message);
    if (output.slam) {
      followSlam(now, output);
      output.map = slam_.mapIfDue(toStamp(output.slam->pose->header.stamp));
    }
    return output;
  }

  const StageTimes& times() const { return times_; }
  std::array<const StageMonitor*, 3> monitors() const {
    return {&slam_monitor_, &detector_monitor_, &tracker_monitor_};
  }

 private:
  bool isFromSlam(const geometry_msgs::TransformStamped& transform) const;
  void followSlam(Stamp now, Output& output);
  void drainTracker(Stamp now, Output& output);
  void bookTime(const StageMonitor& monitor);

  PipelineOptions options_;
  LastStage last_;
  TransformBuffer transforms_;
  StageMonitor slam_monitor_{"grid_slam"};
  StageMonitor detector_monitor_{"moving_objects"};
  StageMonitor tracker_monitor_{"tracker"};
  GridSlamStage slam_;
  MovingObjectsStage detector_;
  TrackerStage tracker_;
  StageTimes times_;
};

}  // namespace datmo
