#include "pipeline.h"

#include <algorithm>

namespace datmo {

Pipeline::Pipeline(const PipelineOptions& options, LastStage last)
    : options_(options),
      last_(last),
      transforms_(options.grid_slam.input.restart_after),
      slam_(options.grid_slam, transforms_, slam_monitor_),
      detector_(options.moving_objects, detector_monitor_),
      tracker_(options.tracker, transforms_, tracker_monitor_) {}

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
  drainTracker(now, output);
  return output;
}

void Pipeline::takeOdometry(const nav_msgs::Odometry& message) { slam_.takeOdometry(message); }

void Pipeline::followSlam(Stamp now, Output& output) {
  bookTime(slam_monitor_);
  tf2_msgs::TFMessage map_to_odom;
  map_to_odom.transforms = output.slam->transforms;
  transforms_.add(map_to_odom);
  if (last_ == LastStage::kGridSlam) {
    return;
  }
  output.objects = detector_.takeSplitScan(*output.slam->split_scan);
  if (output.objects) {
    bookTime(detector_monitor_);
  }
  if (output.objects && last_ == LastStage::kTracker) {
    tracker_.takeSplitScan(*output.slam->split_scan);
    tracker_.takeObjects(output.objects, now);
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

}  // namespace datmo
