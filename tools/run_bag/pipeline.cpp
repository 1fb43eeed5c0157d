#include "pipeline.h"

#include <algorithm>
#include <utility>

namespace datmo {

namespace {

/// grid_slam waits for fused grids where there are any, and for nothing else.
PipelineOptions wired(PipelineOptions options, const Wiring& wiring) {
  options.grid_slam.fused_grid = wiring.low_level_fusion;
  return options;
}

}  // namespace

Pipeline::Pipeline(const PipelineOptions& options, const Wiring& wiring)
    : options_(wired(options, wiring)),
      last_(wiring.last),
      transforms_(options_.grid_slam.input.restart_after),
      low_level_(wiring.low_level_fusion
                     ? std::make_unique<LowLevelPipeline>(options_.low_level, wiring.stereo,
                                                          transforms_, times_)
                     : nullptr),
      slam_(options_.grid_slam, transforms_, slam_monitor_),
      detector_(options_.moving_objects, detector_monitor_),
      tracker_(options_.tracker, transforms_, tracker_monitor_) {}

void Pipeline::takeStaticTransforms(const tf2_msgs::TFMessage& message) {
  transforms_.addStatic(message);
}

bool Pipeline::isFromSlam(const geometry_msgs::TransformStamped& transform) const {
  const GridSlamStageOptions& slam = options_.grid_slam;
  return transform.child_frame_id == slam.odom_frame ||
         (!slam.odometry && transform.child_frame_id == slam.base_frame);
}

Pipeline::Output Pipeline::takeTransforms(const tf2_msgs::TFMessage& message, Stamp now) {
  tf2_msgs::TFMessage others = message;
  auto& transforms = others.transforms;
  transforms.erase(std::remove_if(transforms.begin(), transforms.end(),
                                  [&](const auto& transform) { return isFromSlam(transform); }),
                   transforms.end());
  transforms_.add(others);
  Output output;
  followFusion(now, output);
  drainTracker(now, output);
  return output;
}

template <typename Take>
Pipeline::Output Pipeline::throughFusion(Stamp now, const Take& take) {
  Output output;
  if (low_level_) {
    take(output.grids);
    followFusion(now, output);
  }
  return output;
}

Pipeline::Output Pipeline::takeOdometry(const nav_msgs::Odometry& message, Stamp now) {
  slam_.takeOdometry(message);
  return throughFusion(now, [&](auto& /*grids*/) { low_level_->takeOdometry(message); });
}

Pipeline::Output Pipeline::takeCloud(const sensor_msgs::PointCloud2& message, Stamp now) {
  return throughFusion(now, [&](auto& grids) { low_level_->takeCloud(message, now, grids); });
}

Pipeline::Output Pipeline::takeImage(StereoSide side, const sensor_msgs::ImageConstPtr& image,
                                     Stamp now) {
  return throughFusion(now, [&](auto& grids) { low_level_->takeImage(side, image, now, grids); });
}

Pipeline::Output Pipeline::takeCameraInfo(StereoSide side,
                                          const sensor_msgs::CameraInfoConstPtr& info, Stamp now) {
  return throughFusion(now,
                       [&](auto& grids) { low_level_->takeCameraInfo(side, info, now, grids); });
}

Pipeline::Output Pipeline::takeGrid(const std::string& source, const nav_msgs::OccupancyGrid& grid,
                                    Stamp now) {
  return throughFusion(now, [&](auto& /*grids*/) { low_level_->takeGrid(source, grid, now); });
}

Pipeline::Output Pipeline::finish(Stamp now) {
  Output output;
  if (low_level_) {
    followFusion(low_level_->endOfWaiting(now), output);
  }
  return output;
}

void Pipeline::followFusion(Stamp now, Output& output) {
  if (!low_level_) {
    return;
  }
  while (const auto fused = low_level_->nextFused(now, output.grids)) {
    if (last_ == LastStage::kGridFusion) {
      continue;
    }
    if (auto slam = slam_.takeGrid(*fused)) {
      low_level_->takePose(*slam->pose);
      followSlam(std::move(*slam), now, output);
    }
  }
}

void Pipeline::followSlam(GridSlamOutput slam, Stamp now, Output& output) {
  bookTime(slam_monitor_);
  tf2_msgs::TFMessage map_to_odom;
  map_to_odom.transforms = slam.transforms;
  transforms_.add(map_to_odom);
  if (last_ != LastStage::kGridSlam) {
    detect(slam, now, output);
  }
  if (const auto map = slam_.mapIfDue(toStamp(slam.pose->header.stamp))) {
    output.maps.push_back(map);
  }
  output.slam.push_back(std::move(slam));
}

void Pipeline::detect(const GridSlamOutput& slam, Stamp now, Output& output) {
  if (const ObjectArrayPtr objects = detector_.takeSplitScan(*slam.split_scan)) {
    bookTime(detector_monitor_);
    output.objects.push_back(objects);
    if (last_ == LastStage::kTracker) {
      tracker_.takeSplitScan(*slam.split_scan);
      tracker_.takeObjects(objects, now);
    }
  }
  drainTracker(now, output);
}

void Pipeline::drainTracker(Stamp now, Output& output) {
  while (const TrackArrayPtr tracks = tracker_.next(now)) {
    bookTime(tracker_monitor_);
    output.tracks.push_back(tracks);
  }
}

void Pipeline::bookTime(const StageMonitor& monitor) {
  times_.add(monitor.stage(), monitor.lastProcessed().seconds);
}

std::vector<const StageMonitor*> Pipeline::monitors() const {
  std::vector<const StageMonitor*> monitors;
  if (low_level_) {
    monitors = low_level_->monitors();
  }
  monitors.insert(monitors.end(), {&slam_monitor_, &detector_monitor_, &tracker_monitor_});
  return monitors;
}

}  // namespace datmo
