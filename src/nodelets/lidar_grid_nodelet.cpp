#include <memory>

#include <nodelet/nodelet.h>
#include <pluginlib/class_list_macros.hpp>

#include "datmo_fusion/ros/frame_ids.h"
#include "datmo_fusion/ros/lidar_grid_stage.h"
#include "datmo_fusion/ros/parameters.h"
#include "datmo_fusion/ros/stage_reporter.h"
#include "datmo_fusion/ros/transform_subscription.h"

namespace datmo {

/// The door to LidarGridStage. In: scan or echoes, odometry or else pose, tf. Out: grids/lidar.
class LidarGridNodelet : public nodelet::Nodelet {
 private:
  void onInit() override {
    const auto options = loadOptions<LidarGridStageOptions>(getPrivateNodeHandle());
    monitor_ = std::make_unique<StageMonitor>(getName());
    transforms_ = std::make_unique<TransformBuffer>(
        options.input.restart_after, loadSharedOptions(getPrivateNodeHandle()), *monitor_);
    stage_ = std::make_unique<LidarGridStage>(options, *transforms_, *monitor_);
    const std::vector<std::string> inputs{"scan", options.motion.hasSpeed() ? "odometry" : "pose"};
    reporter_ = std::make_unique<StageReporter>(getNodeHandle(), getPrivateNodeHandle(), *monitor_,
                                                inputs, options.input.silence_after);
    grid_ = getNodeHandle().advertise<nav_msgs::OccupancyGrid>("grids/lidar", kQueue);
    subscribe(options.motion);
  }

  void subscribe(const MotionOptions& motion) {
    ros::NodeHandle& node = getNodeHandle();
    const auto hints = ros::TransportHints().tcpNoDelay();
    transform_subscription_ =
        std::make_unique<TransformSubscription>(node, *transforms_, *monitor_);
    if (motion.hasSpeed()) {
      motion_ = node.subscribe(motion.odometryTopic(), kMotionQueue,
                               &LidarGridNodelet::takeOdometry, this, hints);
    } else {
      motion_ = node.subscribe("pose", kQueue, &LidarGridNodelet::takePose, this, hints);
    }
    scan_ = node.subscribe("scan", kQueue, &LidarGridNodelet::takeScan<sensor_msgs::LaserScan>,
                           this, hints);
    reporter_->alsoOn("scan", node.resolveName("echoes"));
    echoes_ =
        node.subscribe("echoes", kQueue,
                       &LidarGridNodelet::takeScan<sensor_msgs::MultiEchoLaserScan>, this, hints);
  }

  void takeOdometry(const nav_msgs::OdometryConstPtr& message) {
    stage_->takeOdometry(*receive("odometry", message, *monitor_));
  }

  void takePose(const geometry_msgs::PoseWithCovarianceStampedConstPtr& message) {
    stage_->takePose(*receive("pose", message, *monitor_));
  }

  template <typename Message>
  void takeScan(const boost::shared_ptr<const Message>& message) {
    if (const auto grid = stage_->takeScan(*receive("scan", message, *monitor_))) {
      grid_.publish(grid);
      reporter_->publishTiming();
    }
  }

  /// A second of scans or poses, and of odometry: enough for a hiccup, and bounded.
  static constexpr std::uint32_t kQueue = 20;
  static constexpr std::uint32_t kMotionQueue = 200;

  std::unique_ptr<StageMonitor> monitor_;
  std::unique_ptr<TransformBuffer> transforms_;
  std::unique_ptr<LidarGridStage> stage_;
  std::unique_ptr<StageReporter> reporter_;
  std::unique_ptr<TransformSubscription> transform_subscription_;
  ros::Publisher grid_;
  ros::Subscriber motion_;
  ros::Subscriber scan_;
  ros::Subscriber echoes_;
};

}  // namespace datmo

PLUGINLIB_EXPORT_CLASS(datmo::LidarGridNodelet, nodelet::Nodelet)
