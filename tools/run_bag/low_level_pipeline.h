#pragma once

#include <string>
#include <utility>
#include <vector>

#include "pipeline_options.h"
#include "stage_times.h"

#include "datmo_fusion/ros/stage_monitor.h"
#include "datmo_fusion/ros/transform_buffer.h"

namespace datmo {

/// The stages before grid_slam with low-level fusion:
///
///     scan, odometry, tf ──────────────► lidar_grid ── lidar ──┐
///     points2, right camera_info, tf ──► stereo_grid ─ stereo ─┴► grid_fusion ─ fused, conflict
///
/// `now` is always the time at which a message came.
class LowLevelPipeline {
 public:
  /// A grid and its name: lidar, stereo, fused, conflict.
  using NamedGrid = std::pair<std::string, nav_msgs::OccupancyGridPtr>;

  /// `transforms` and `times` must outlive this. Throws OptionError.
  LowLevelPipeline(const LowLevelOptions& options, const TransformBuffer& transforms,
                   StageTimes& times);

  /// `Message`: sensor_msgs::LaserScan or MultiEchoLaserScan. The grids that it leads to are added
  /// to `grids`; the same holds for all below.
  template <typename Message>
  void takeScan(const Message& message, Stamp now, std::vector<NamedGrid>& grids) {
    offer("lidar", lidar_.takeScan(message), lidar_monitor_, now, grids);
  }

  void takeCloud(const sensor_msgs::PointCloud2& message, Stamp now, std::vector<NamedGrid>& grids);
  /// Of the right camera.
  void takeCameraInfo(const sensor_msgs::CameraInfo& message) { stereo_.takeCameraInfo(message); }

  /// A grid of a source that has no stage here.
  void takeGrid(const std::string& source, const nav_msgs::OccupancyGrid& grid, Stamp now);

  void takeOdometry(const nav_msgs::Odometry& message);
  void takePose(const geometry_msgs::PoseWithCovarianceStamped& message);

  /// The next fused grid that is ready; null if there is none. To be asked until there is none.
  nav_msgs::OccupancyGridPtr nextFused(Stamp now, std::vector<NamedGrid>& grids);

  /// When the last grid that waits for others waits no more, if the last message came at `now`.
  Stamp endOfWaiting(Stamp now) const { return now + longest_wait_; }

  std::vector<const StageMonitor*> monitors() const {
    return {&lidar_monitor_, &stereo_monitor_, &fusion_monitor_};
  }

 private:
  /// Takes a new grid (null: there is none) to the fusion, if that uses it.
  void offer(const std::string& source, const nav_msgs::OccupancyGridPtr& grid,
             const StageMonitor& monitor, Stamp now, std::vector<NamedGrid>& grids);
  void bookTime(const StageMonitor& monitor);

  StageTimes& times_;
  double longest_wait_;  ///< s
  StageMonitor lidar_monitor_{"lidar_grid"};
  StageMonitor stereo_monitor_{"stereo_grid"};
  StageMonitor fusion_monitor_{"grid_fusion"};
  LidarGridStage lidar_;
  StereoGridStage stereo_;
  GridFusionStage fusion_;
  std::vector<std::string> sources_;
};

}  // namespace datmo
