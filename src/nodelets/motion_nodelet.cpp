#include <memory>
#include <string>
#include <vector>

#include <nodelet/nodelet.h>
#include <pluginlib/class_list_macros.hpp>

#include "datmo_fusion/ros/frame_ids.h"
#include "datmo_fusion/ros/motion_stage.h"
#include "datmo_fusion/ros/parameters.h"
#include "datmo_fusion/ros/stage_reporter.h"
#include "datmo_fusion/ros/transform_subscription.h"

namespace datmo {

/// The door to MotionStage. In, as motion/source says: imu; twist or twist_with_covariance;
/// joint_states; tf. Out: motion/odometry. Where the vehicle has odometry, or nothing tells the
/// motion, it does nothing.
class MotionNodelet : public nodelet::Nodelet {
 private:
  void onInit() override {
    const SharedOptions shared = loadSharedOptions(getPrivateNodeHandle());
    if (!shared.motion.fromSensors()) {
      return;
    }
    const MotionStageOptions options{shared.frames, shared.motion, StreamOptions()};
    monitor_ = std::make_unique<StageMonitor>(getName());
    transforms_ = std::make_unique<TransformBuffer>(options.input.restart_after, shared, *monitor_);
    stage_ = std::make_unique<MotionStage>(options, *transforms_, *monitor_);
    reporter_ =
        std::make_unique<StageReporter>(getNodeHandle(), getPrivateNodeHandle(), *monitor_,
                                        inputsOf(options.motion), options.input.silence_after);
    odometry_ =
        getNodeHandle().advertise<nav_msgs::Odometry>(options.motion.odometryTopic(), kQueue);
    transform_subscription_ =
        std::make_unique<TransformSubscription>(getNodeHandle(), *transforms_, *monitor_);
    subscribe(options.motion);
  }

  static std::vector<std::string> inputsOf(const MotionOptions& motion) {
    std::vector<std::string> inputs;
    for (const auto& [used, input] :
         {std::pair(motion.usesImu(), kImu), std::pair(motion.usesTwist(), kTwist),
          std::pair(motion.usesWheels(), kWheels)}) {
      if (used) {
        inputs.emplace_back(input);
      }
    }
    return inputs;
  }

  void subscribe(const MotionOptions& motion) {
    ros::NodeHandle& node = getNodeHandle();
    const auto hints = ros::TransportHints().tcpNoDelay();
    if (motion.usesImu()) {
      subscribers_.push_back(node.subscribe(kImu, kQueue, &MotionNodelet::takeImu, this, hints));
    }
    if (motion.usesTwist()) {
      subscribers_.push_back(node.subscribe(
          kTwist, kQueue, &MotionNodelet::takeTwist<geometry_msgs::TwistStamped>, this, hints));
      subscribers_.push_back(node.subscribe(
          "twist_with_covariance", kQueue,
          &MotionNodelet::takeTwist<geometry_msgs::TwistWithCovarianceStamped>, this, hints));
    }
    if (motion.usesWheels()) {
      subscribers_.push_back(
          node.subscribe(kWheels, kQueue, &MotionNodelet::takeWheels, this, hints));
    }
  }

  void takeImu(const sensor_msgs::ImuConstPtr& message) {
    publish(stage_->takeImu(*receive(kImu, message, *monitor_)));
  }

  template <typename Message>
  void takeTwist(const boost::shared_ptr<const Message>& message) {
    publish(stage_->takeTwist(*receive(kTwist, message, *monitor_)));
  }

  void takeWheels(const sensor_msgs::JointStateConstPtr& message) {
    publish(stage_->takeWheels(*receive(kWheels, message, *monitor_)));
  }

  void publish(const nav_msgs::OdometryPtr& odometry) {
    if (odometry) {
      odometry_.publish(odometry);
    }
  }

  /// A second of a fast Imu: enough for a hiccup, and bounded.
  static constexpr std::uint32_t kQueue = 200;
  static constexpr const char* kImu = "imu";
  static constexpr const char* kTwist = "twist";
  static constexpr const char* kWheels = "joint_states";

  std::unique_ptr<StageMonitor> monitor_;
  std::unique_ptr<TransformBuffer> transforms_;
  std::unique_ptr<MotionStage> stage_;
  std::unique_ptr<StageReporter> reporter_;
  std::unique_ptr<TransformSubscription> transform_subscription_;
  ros::Publisher odometry_;
  std::vector<ros::Subscriber> subscribers_;
};

}  // namespace datmo

PLUGINLIB_EXPORT_CLASS(datmo::MotionNodelet, nodelet::Nodelet)
