#pragma once

#include <string>
#include <vector>

#include "source_fusion_nodelet.h"

#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <nav_msgs/Odometry.h>

namespace datmo {

/// A SourceFusionNodelet whose messages are in the vehicle's frame, which moves. In, besides those:
/// odometry or else pose.
template <typename Stage, typename Options, typename Message>
class MovingFusionNodelet : public SourceFusionNodelet<Stage, Options, Message> {
 protected:
  using Base = SourceFusionNodelet<Stage, Options, Message>;
  using Base::Base;
  using Base::kQueue;

 private:
  std::vector<std::string> otherInputs(const Options& options) const override {
    return {options.motion.hasSpeed() ? "odometry" : "pose"};
  }

  void subscribeOthers(const Options& options) override {
    ros::NodeHandle& node = this->getNodeHandle();
    motion_ =
        options.motion.hasSpeed()
            ? node.subscribe(options.motion.odometryTopic(), kMotionQueue,
                             &MovingFusionNodelet::takeOdometry, this, Base::hints())
            : node.subscribe("pose", kQueue, &MovingFusionNodelet::takePose, this, Base::hints());
  }

  void takeOdometry(const nav_msgs::OdometryConstPtr& message) {
    this->stage().takeOdometry(*receive("odometry", message, this->monitor()));
  }

  void takePose(const geometry_msgs::PoseWithCovarianceStampedConstPtr& message) {
    this->stage().takePose(*receive("pose", message, this->monitor()));
  }

  /// A second of a fast Imu.
  static constexpr std::uint32_t kMotionQueue = 200;

  ros::Subscriber motion_;
};

}  // namespace datmo
