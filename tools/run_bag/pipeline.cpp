#include "pipeline.h"

#include <algorithm>
#include <utility>

namespace datmo {

namespace {

/// grid_slam waits for fused grids where there are any, and for nothing else; moving_objects takes
/// borders of the road where they are looked for; what the scanner saw is no view of the stereo
/// camera.
PipelineOptions wired(PipelineOptions options, const Wiring& wiring) {
  options.grid_slam.fused_grid = wiring.low_level_fusion;
  options.track_level.stereo_tracker.scan_view = false;
  options.moving_objects.road_borders = wiring.road_border;
  return options;
}

/// Whether a level takes the objects of the stereo camera.
bool usesStereoObjects(const PipelineOptions& options, const Wiring& wiring) {
  const auto isStereo = [](const std::vector<std::string>& sources) {
    return std::find(sources.begin(), sources.end(), "stereo") != sources.end();
  };
  return (wiring.object_fusion && isStereo(options.object_fusion.fuser.sourcesInUse())) ||
         (wiring.track_fusion && isStereo(options.track_level.track_fusion.fuser.sourcesInUse()));
}

}  // namespace

Pipeline::Pipeline(const PipelineOptions& options, const Wiring& wiring)
    : options_(wired(options, wiring)),
      last_(wiring.last),
      transforms_(options_.grid_slam.input.restart_after, options_.shared, inputs_monitor_),
      low_level_(wiring.low_level_fusion
                     ? std::make_unique<LowLevelPipeline>(options_.low_level, transforms_, times_)
                     : nullptr),
      object_fusion_(wiring.object_fusion
                         ? std::make_unique<ObjectFusionPipeline>(options_.object_fusion, times_)
                         : nullptr),
      track_fusion_(wiring.track_fusion
                        ? std::make_unique<TrackFusionPipeline>(options_.track_level, wiring.last,
                                                                transforms_, times_)
                        : nullptr),
      motion_({options_.shared.frames, options_.shared.motion, options_.grid_slam.input},
              transforms_, motion_monitor_),
      slam_(options_.grid_slam, transforms_, slam_monitor_),
      detector_(options_.moving_objects, detector_monitor_),
      tracker_(options_.tracker, transforms_, tracker_monitor_) {
  if (wiring.scan_from_cloud) {
    cloud_to_scan_.emplace(options_.cloud_to_scan, transforms_, cloud_monitor_);
  }
  if (wiring.road_border) {
    road_border_.emplace(options_.road_border, road_border_monitor_);
  }
  if (wiring.stereo != StereoPoints::kClouds) {
    images_.emplace(options_.stereo_images, wiring.stereo == StereoPoints::kRectifiedImages,
                    images_monitor_);
  }
  if (usesStereoObjects(options_, wiring)) {
    stereo_objects_.emplace(options_.stereo_objects, transforms_, stereo_objects_monitor_);
  }
}

void Pipeline::takeStaticTransforms(const tf2_msgs::TFMessage& message) {
  transforms_.addStatic(message);
}

bool Pipeline::isFromSlam(const geometry_msgs::TransformStamped& transform) const {
  const auto& [frames, mounts, motion] = options_.shared;
  return transform.child_frame_id == frames.odom ||
         (!motion.fromOdometry() && transform.child_frame_id == frames.base);
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

Pipeline::Output Pipeline::takeImu(const sensor_msgs::Imu& message, Stamp now) {
  return followMotion(motion_.takeImu(message), now);
}

Pipeline::Output Pipeline::takeWheels(const sensor_msgs::JointState& message, Stamp now) {
  return followMotion(motion_.takeWheels(message), now);
}

Pipeline::Output Pipeline::followMotion(const nav_msgs::OdometryPtr& odometry, Stamp now) {
  if (odometry) {
    bookTime(motion_monitor_);
    return takeOdometry(*odometry, now);
  }
  return {};
}

Pipeline::Output Pipeline::takeLidarCloud(const sensor_msgs::PointCloud2& message, Stamp now) {
  Output output;
  if (!cloud_to_scan_) {
    return output;
  }
  if (auto scan = cloud_to_scan_->takeCloud(message)) {
    bookTime(cloud_monitor_);
    if (scan->mount) {
      tf2_msgs::TFMessage mount;
      mount.transforms = {*scan->mount};
      transforms_.addStatic(mount);
    }
    feedScan(*scan->scan, now, output);
    output.cloud_scans.push_back(std::move(*scan));
  }
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
  if (stereo_objects_ && side == StereoSide::kRight) {
    stereo_objects_->takeCameraInfo(*info);
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

Pipeline::Output Pipeline::takeObjects(const std::string& source,
                                       const ObjectArrayConstPtr& objects, Stamp now) {
  feedObjects(source, objects, now);
  Output output;
  followFusion(now, output);
  return output;
}

Pipeline::Output Pipeline::takeTracks(const std::string& source, const TrackArray& tracks,
                                      Stamp now) {
  if (track_fusion_) {
    track_fusion_->takeTracks(source, tracks, now);
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
  followTracks(end, output);
  if (track_fusion_) {
    end = track_fusion_->endOfTracking(end);
    followTracks(end, output);
    followTracks(track_fusion_->endOfWaiting(end), output);
  }
  return output;
}

std::vector<const StageMonitor*> Pipeline::monitors() const {
  std::vector<const StageMonitor*> monitors = doors();
  monitors.push_back(&tracker_monitor_);
  return monitors;
}

std::vector<const StageMonitor*> Pipeline::doors() const {
  std::vector<const StageMonitor*> monitors{&inputs_monitor_};
  if (options_.shared.motion.fromSensors()) {
    monitors.push_back(&motion_monitor_);
  }
  if (cloud_to_scan_) {
    monitors.push_back(&cloud_monitor_);
  }
  if (images_) {
    monitors.push_back(&images_monitor_);
  }
  if (low_level_) {
    const auto low_level = low_level_->monitors();
    monitors.insert(monitors.end(), low_level.begin(), low_level.end());
  }
  monitors.push_back(&slam_monitor_);
  if (road_border_) {
    monitors.push_back(&road_border_monitor_);
  }
  monitors.push_back(&detector_monitor_);
  if (stereo_objects_) {
    monitors.push_back(&stereo_objects_monitor_);
  }
  if (object_fusion_) {
    const auto object_level = object_fusion_->monitors();
    monitors.insert(monitors.end(), object_level.begin(), object_level.end());
  }
  if (track_fusion_) {
    const auto track_level = track_fusion_->monitors();
    monitors.insert(monitors.end(), track_level.begin(), track_level.end());
  }
  return monitors;
}

}  // namespace datmo
