#include <string>

#include "moving_fusion_nodelet.h"

#include <pluginlib/class_list_macros.hpp>

#include "datmo_fusion/ros/object_fusion_stage.h"

namespace datmo {

/// The door to ObjectFusionStage. In: objects/<source> of each source, odometry or else pose,
/// split_scan. Out: objects/fused.
class ObjectFusionNodelet
    : public MovingFusionNodelet<ObjectFusionStage, ObjectFusionStageOptions, ObjectArray> {
 public:
  ObjectFusionNodelet() : MovingFusionNodelet("objects") {}

 private:
  void prepare(const ObjectFusionStageOptions& /*options*/) override {
    ros::NodeHandle& node = getNodeHandle();
    fused_ = node.advertise<ObjectArray>("objects/fused", kQueue);
    split_scan_ =
        node.subscribe("split_scan", kQueue, &ObjectFusionNodelet::takeSplitScan, this, hints());
  }

  void take(const std::string& source, const ObjectArray& message, Stamp now) override {
    stage().takeObjects(source, message, now);
  }

  void takeSplitScan(const SplitScanConstPtr& message) { stage().takeSplitScan(*message); }

  bool publishNext(Stamp now) override {
    const auto objects = stage().next(now);
    if (objects) {
      fused_.publish(objects);
    }
    return objects != nullptr;
  }

  ros::Publisher fused_;
  ros::Subscriber split_scan_;
};

}  // namespace datmo

PLUGINLIB_EXPORT_CLASS(datmo::ObjectFusionNodelet, nodelet::Nodelet)
