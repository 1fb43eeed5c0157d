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
                     ? std::make_unique<LowLevelPipeline>(options_.low_level, transforms_, times_)
                     : nullptr),
      object_fusion_(wiring.object_fusion ? std::make_unique<ObjectFusionPipeline>(
                                                options_.object_level, transforms_, times_)
                                          : nullptr),
      slam_(options_.grid_slam, transforms_, slam_monitor_),
      detector_(options_.moving_objects, detector_monitor_),
      tracker_(options_.tracker, transforms_, tracker_monitor_) {
  if (wiring.stereo != StereoPoints::kClouds) {
    images_.emplace(options_.stereo_images, wiring.stereo == StereoPoints::kRectifiedImages,
                    images_monitor_);
  }
}

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

Pipeline::Output Pipeline::takeOdometry(const nav_msgs::Odometry& message, Stamp now) {
  slam_.takeOdometry(message);
  if (low_level_) {
    low_level_->takeOdometry(message);
  }
  if (object_fusion_) {
    object_fusion_->takeOdometry(message);
  }
  Output output;
  followFusion(now, output);
  return output;
}

Pipeline::Output Pipeline::takeCloud(const sensor_msgs::PointCloud2& message, Stamp now) {
  Output output;
  feedCloud(message, now, output);
  followFusion(now, output);
  return output;
}

Pipeline::Output Pipeline::takeImage(StereoSide side, const sensor_msgs::ImageConstPtr& image,
                                     Stamp now) {
  Output output;
  if (images_) {
    feedMadeCloud(images_->takeImage(side, image), now, output);
  }
  followFusion(now, output);
  return output;
}

Pipeline::Output Pipeline::takeCameraInfo(StereoSide side,
                                          const sensor_msgs::CameraInfoConstPtr& info, Stamp now) {
  if (low_level_ && side == StereoSide::kRight) {
    low_level_->takeCameraInfo(*info);
  }
  if (object_fusion_ && side == StereoSide::kRight) {
    object_fusion_->takeCameraInfo(*info);
  }
  Output output;
  if (images_) {
    feedMadeCloud(images_->takeInfo(side, info), now, output);
  }
  followFusion(now, output);
  return output;
}

Pipeline::Output Pipeline::takeGrid(const std::string& source, const nav_msgs::OccupancyGrid& grid,
                                    Stamp now) {
  if (low_level_) {
    low_level_->takeGrid(source, grid, now);
  }
  Output output;
  followFusion(now, output);
  return output;
}

Pipeline::Output Pipeline::takeObjects(const std::string& source, const ObjectArray& objects,
                                       Stamp now) {
  if (object_fusion_) {
    object_fusion_->takeObjects(source, objects, now);
  }
  Output output;
  followFusion(now, output);
  return output;
}

Pipeline::Output Pipeline::finish(Stamp now) {
  Output output;
  Stamp end = now;
  if (low_level_) {
    end = low_level_->endOfWaiting(end);
    followGrids(end, output);
  }
  if (object_fusion_) {
    end = object_fusion_->endOfWaiting(end);
    followObjects(end, output);
  }
  return output;
}

void Pipeline::feedCloud(const sensor_msgs::PointCloud2& cloud, Stamp now, Output& output) {
  if (low_level_) {
    low_level_->takeCloud(cloud, now, output.grids);
  }
  if (object_fusion_) {
    object_fusion_->takeCloud(cloud, now, output.objects);
  }
}

void Pipeline::feedMadeCloud(const sensor_msgs::PointCloud2Ptr& cloud, Stamp now, Output& output) {
  if (cloud) {
    bookTime(images_monitor_);
    feedCloud(*cloud, now, output);
  }
}

void Pipeline::followFusion(Stamp now, Output& output) {
  followGrids(now, output);
  followObjects(now, output);
}

void Pipeline::followGrids(Stamp now, Output& output) {
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

void Pipeline::followObjects(Stamp now, Output& output) {
  if (!object_fusion_) {
    return;
  }
  while (const ObjectArrayPtr fused = object_fusion_->nextFused(now, output.objects)) {
    if (last_ == LastStage::kTracker) {
      tracker_.takeObjects(fused, now);
    }
  }
  drainTracker(now, output);
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
  if (last_ == LastStage::kTracker) {
    tracker_.takeSplitScan(*slam.split_scan);
  }
  if (object_fusion_) {
    object_fusion_->takePose(*slam.pose);
    object_fusion_->takeSplitScan(*slam.split_scan);
  }
  if (const ObjectArrayPtr objects = detector_.takeSplitScan(*slam.split_scan)) {
    bookTime(detector_monitor_);
    output.objects.emplace_back("lidar", objects);
    if (object_fusion_) {
      object_fusion_->takeObjects("lidar", *objects, now);
    } else if (last_ == LastStage::kTracker) {
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
  if (images_) {
    monitors.push_back(&images_monitor_);
  }
  if (low_level_) {
    const auto low_level = low_level_->monitors();
    monitors.insert(monitors.end(), low_level.begin(), low_level.end());
  }
  monitors.insert(monitors.end(), {&slam_monitor_, &detector_monitor_});
  if (object_fusion_) {
    const auto object_level = object_fusion_->monitors();
    monitors.insert(monitors.end(), object_level.begin(), object_level.end());
  }
  monitors.push_back(&tracker_monitor_);
  return monitors;
}

}  // namespace datmo
