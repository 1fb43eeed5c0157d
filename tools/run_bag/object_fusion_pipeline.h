#pragma once

#include <string>
#include <utility>
#include <vector>

#include "pipeline_options.h"
#include "stage_times.h"

#include "datmo_fusion/ros/stage_monitor.h"

namespace datmo {

/// The stages between moving_objects and tracker with object-level fusion:
///
///     odometry, split scan, objects of moving_objects ── lidar ──┐
///     objects of stereo_objects ──────────────────────── stereo ─┴► object_fusion ─ fused
///
/// `now` is always the time at which a message came.
class ObjectFusionPipeline {
 public:
  /// Objects and the name of their source: lidar, stereo, or fused.
  using NamedObjects = std::pair<std::string, ObjectArrayPtr>;

  /// `times` must outlive this. Throws OptionError.
  ObjectFusionPipeline(const ObjectFusionStageOptions& options, StageTimes& times);

  /// Objects of moving_objects (lidar), of stereo_objects (stereo), or of a source that has no
  /// stage here.
  void takeObjects(const std::string& source, const ObjectArray& objects, Stamp now);

  void takeSplitScan(const SplitScanMessage& message);
  void takeOdometry(const nav_msgs::Odometry& message);
  void takePose(const geometry_msgs::PoseWithCovarianceStamped& message);

  /// The next fused objects that are ready, which are added to `objects`; null if there are none.
  /// To be asked until there are none.
  ObjectArrayPtr nextFused(Stamp now, std::vector<NamedObjects>& objects);

  /// When the last objects that wait for others wait no more, if the last message came at `now`.
  Stamp endOfWaiting(Stamp now) const { return now + longest_wait_; }

  std::vector<const StageMonitor*> monitors() const { return {&fusion_monitor_}; }

 private:
  bool isInUse(const std::string& source) const;
  StageTimes& times_;
  double longest_wait_;  ///< s
  StageMonitor fusion_monitor_{"object_fusion"};
  ObjectFusionStage fusion_;
  std::vector<std::string> sources_;
};

}  // namespace datmo
