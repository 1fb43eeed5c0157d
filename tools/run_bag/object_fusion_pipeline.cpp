#include "object_fusion_pipeline.h"

#include <algorithm>

namespace datmo {

ObjectFusionPipeline::ObjectFusionPipeline(const ObjectFusionOptions& options,
                                           const TransformBuffer& transforms, StageTimes& times)
    : times_(times),
      longest_wait_(options.object_fusion.matcher.longest_wait),
      stereo_(options.stereo_objects, transforms, stereo_monitor_),
      fusion_(options.object_fusion, fusion_monitor_),
      sources_(fusion_.sources()) {}

void ObjectFusionPipeline::takeCloud(const sensor_msgs::PointCloud2& message, Stamp now,
                                     std::vector<NamedObjects>& objects) {
  if (!isInUse("stereo")) {
    return;
  }
  if (const ObjectArrayPtr found = stereo_.takeCloud(message)) {
    bookTime(stereo_monitor_);
    objects.emplace_back("stereo", found);
    fusion_.takeObjects("stereo", *found, now);
  }
}

void ObjectFusionPipeline::takeCameraInfo(const sensor_msgs::CameraInfo& message) {
  stereo_.takeCameraInfo(message);
}

void ObjectFusionPipeline::takeObjects(const std::string& source, const ObjectArray& objects,
                                       Stamp now) {
  if (isInUse(source)) {
    fusion_.takeObjects(source, objects, now);
  }
}

void ObjectFusionPipeline::takeSplitScan(const SplitScanMessage& message) {
  fusion_.takeSplitScan(message);
}

void ObjectFusionPipeline::takeOdometry(const nav_msgs::Odometry& message) {
  fusion_.takeOdometry(message);
}

void ObjectFusionPipeline::takePose(const geometry_msgs::PoseWithCovarianceStamped& message) {
  fusion_.takePose(message);
}

ObjectArrayPtr ObjectFusionPipeline::nextFused(Stamp now, std::vector<NamedObjects>& objects) {
  ObjectArrayPtr fused = fusion_.next(now);
  if (fused) {
    bookTime(fusion_monitor_);
    objects.emplace_back("fused", fused);
  }
  return fused;
}

bool ObjectFusionPipeline::isInUse(const std::string& source) const {
  return std::find(sources_.begin(), sources_.end(), source) != sources_.end();
}

void ObjectFusionPipeline::bookTime(const StageMonitor& monitor) {
  times_.add(monitor.stage(), monitor.lastProcessed().seconds);
}

}  // namespace datmo
