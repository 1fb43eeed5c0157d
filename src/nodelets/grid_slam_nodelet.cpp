#include <memory>

#include <nodelet/nodelet.h>
#include <pluginlib/class_list_macros.hpp>
#include <tf2_ros/transform_broadcaster.h>

#include "datmo_fusion/ros/frame_ids.h"
#include "datmo_fusion/ros/grid_slam_stage.h"
#include "datmo_fusion/ros/parameters.h"
#include "datmo_fusion/ros/stage_reporter.h"
#include "datmo_fusion/ros/transform_subscription.h"

namespace datmo {

/// The door to GridSlamStage. In: scan or echoes, odometry, tf, with low-level fusion grids/fused.
/// Out: map, pose, split_scan, tf.
class GridSlamNodelet : public nodelet::Nodelet {
 private:
  void onInit() override {
    const auto options = loadOptions<GridSlamStageOptions>(getPrivateNodeHandle());
    monitor_ = std::make_unique<StageMonitor>(getName());
    transforms_ = std::make_unique<TransformBuffer>(
        options.input.restart_after, loadSharedOptions(getPrivateNodeHandle()), *monitor_);
    stage_ = std::make_unique<GridSlamStage>(options, *transforms_, *monitor_);
    std::vector<std::string> inputs{"scan"};
    if (usesOdometry(options)) {
      inputs.emplace_back("odometry");
    }
    if (options.fused_grid) {
      inputs.emplace_back(kFusedGrid);
    }
    reporter_ = std::make_unique<StageReporter>(getNodeHandle(), getPrivateNodeHandle(), *monitor_,
                                                inputs, options.input.silence_after);
    advertise();
    subscribe(options);
  }

  static bool usesOdometry(const GridSlamStageOptions& options) {
    return options.motion.fromOdometry() || options.motion.fromSensors();
  }

  void advertise() {
    ros::NodeHandle& node = getNodeHandle();
    map_ = node.advertise<nav_msgs::OccupancyGrid>("map", 1, true);
    pose_ = node.advertise<geometry_msgs::PoseWithCovarianceStamped>("pose", kQueue);
    split_scan_ = node.advertise<SplitScanMessage>("split_scan", kQueue);
  }

  void subscribe(const GridSlamStageOptions& options) {
    ros::NodeHandle& node = getNodeHandle();
    const auto hints = ros::TransportHints().tcpNoDelay();
    transform_subscription_ =
        std::make_unique<TransformSubscription>(node, *transforms_, *monitor_);
    if (usesOdometry(options)) {
      odometry_ = node.subscribe(options.motion.odometryTopic(), kMotionQueue,
                                 &GridSlamNodelet::takeOdometry, this, hints);
    }
    if (options.fused_grid) {
      fused_grid_ = node.subscribe(kFusedGrid, kQueue, &GridSlamNodelet::takeGrid, this, hints);
    }
    scan_ = node.subscribe("scan", kQueue, &GridSlamNodelet::takeScan<sensor_msgs::LaserScan>, this,
                           hints);
    reporter_->alsoOn("scan", node.resolveName("echoes"));
    echoes_ = node.subscribe(
        "echoes", kQueue, &GridSlamNodelet::takeScan<sensor_msgs::MultiEchoLaserScan>, this, hints);
  }

  void takeOdometry(const nav_msgs::OdometryConstPtr& message) {
    stage_->takeOdometry(*receive("odometry", message, *monitor_));
  }

  template <typename Message>
  void takeScan(const boost::shared_ptr<const Message>& message) {
    if (const auto output = stage_->takeScan(*receive("scan", message, *monitor_))) {
      publish(*output);
    }
  }

  void takeGrid(const nav_msgs::OccupancyGridConstPtr& message) {
    if (const auto output = stage_->takeGrid(*receive(kFusedGrid, message, *monitor_))) {
      publish(*output);
    }
  }

  void publish(const GridSlamOutput& output) {
    broadcaster_.sendTransform(output.transforms);
    pose_.publish(output.pose);
    split_scan_.publish(output.split_scan);
    reporter_->publishTiming();
    if (const auto map = stage_->mapIfDue(toStamp(output.split_scan->header.stamp))) {
      map_.publish(map);
    }
  }

  /// A second of scans, and of odometry: enough for a hiccup, and bounded.
  static constexpr std::uint32_t kQueue = 20;
  static constexpr std::uint32_t kMotionQueue = 200;
  static constexpr const char* kFusedGrid = "grids/fused";

  std::unique_ptr<StageMonitor> monitor_;
  std::unique_ptr<TransformBuffer> transforms_;
  std::unique_ptr<GridSlamStage> stage_;
  std::unique_ptr<StageReporter> reporter_;
  std::unique_ptr<TransformSubscription> transform_subscription_;
  tf2_ros::TransformBroadcaster broadcaster_;
  ros::Publisher map_;
  ros::Publisher pose_;
  ros::Publisher split_scan_;
  ros::Subscriber odometry_;
  ros::Subscriber scan_;
  ros::Subscriber echoes_;
  ros::Subscriber fused_grid_;
};

}  // namespace datmo

PLUGINLIB_EXPORT_CLASS(datmo::GridSlamNodelet, nodelet::Nodelet)
