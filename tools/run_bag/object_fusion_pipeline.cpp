#include "object_fusion_pipeline.h"

#include <algorithm>

namespace datmo {

ObjectFusionPipeline::ObjectFusionPipeline(const ObjectFusionStageOptions& options,
                                           StageTimes& times)
    : times_(times),
      longest_wait_(options.matcher.longest_wait),
      fusion_(options, fusion_monitor_),
      sources_(fusion_.sources()) {}

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
    times_.add(fusion_monitor_.stage(), fusion_monitor_.lastProcessed().seconds);
    objects.emplace_back("fused", fused);
  }
  return fused;
}

bool ObjectFusionPipeline::isInUse(const std::string& source) const {
  return std::find(sources_.begin(), sources_.end(), source) != sources_.end();
}

}  // namespace datmo
