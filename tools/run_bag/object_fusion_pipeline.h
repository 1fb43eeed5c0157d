#pragma once

#include <string>
#include <utility>
#include <vector>

#include "pipeline_options.h"
#include "stage_times.h"

#include "datmo_fusion/ros/stage_monitor.h"
#include "datmo_fusion/ros/transform_buffer.h"

namespace datmo {

/// The stages between moving_objects and tracker with object-level fusion:
///
///     odometry, split scan, objects of moving_objects ── lidar ──┐
///     points2, right camera_info, tf ──► stereo_objects ─ stereo ─┴► object_fusion ─ fused
///
/// `now` is always the time at which a message came.
class ObjectFusionPipeline {
 public:
  /// Objects and the name of their source: lidar, stereo, or fused.
  using NamedObjects = std::pair<std::string, ObjectArrayPtr>;

  /// `transforms` and `times` must outlive this. Throws OptionError.
  ObjectFusionPipeline(const ObjectFusionOptions& options, const TransformBuffer& transforms,
                       StageTimes& times);

  /// The objects that it leads to are added to `objects`; the same holds for nextFused.
  void takeCloud(const sensor_msgs::PointCloud2& message, Stamp now,
                 std::vector<NamedObjects>& objects);
  /// Of the right camera.
  void takeCameraInfo(const sensor_msgs::CameraInfo& message);

  /// Objects of moving_objects (lidar), or of a source that has no stage here.
  void takeObjects(const std::string& source, const ObjectArray& objects, Stamp now);

  void takeSplitScan(const SplitScanMessage& message);
  void takeOdometry(const nav_msgs::Odometry& message);
  void takePose(const geometry_msgs::PoseWithCovarianceStamped& message);

  /// The next fused objects that are ready; null if there are none. To be asked until there are
  /// none.
  ObjectArrayPtr nextFused(Stamp now, std::vector<NamedObjects>& objects);

  /// When the last objects that wait for others wait no more, if the last message came at `now`.
  Stamp endOfWaiting(Stamp now) const { return now + longest_wait_; }

  std::vector<const StageMonitor*> monitors() const { return {&stereo_monitor_, &fusion_monitor_}; }

 private:
  bool isInUse(const std::string& source) const;
  void bookTime(const StageMonitor& monitor);

  StageTimes& times_;
  double longest_wait_;  ///< s
  StageMonitor stereo_monitor_{"stereo_objects"};
  StageMonitor fusion_monitor_{"object_fusion"};
  StereoObjectsStage stereo_;
  ObjectFusionStage fusion_;
  std::vector<std::string> sources_;
};

}  // namespace datmo
