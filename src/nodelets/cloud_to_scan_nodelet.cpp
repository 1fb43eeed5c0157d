#include <memory>

#include <nodelet/nodelet.h>
#include <pluginlib/class_list_macros.hpp>
#include <tf2_ros/static_transform_broadcaster.h>

#include "datmo_fusion/ros/cloud_to_scan_stage.h"
#include "datmo_fusion/ros/frame_ids.h"
#include "datmo_fusion/ros/parameters.h"
#include "datmo_fusion/ros/stage_reporter.h"
#include "datmo_fusion/ros/transform_subscription.h"

namespace datmo {

/// The door to CloudToScanStage. In: cloud, tf. Out: scan, tf_static.
class CloudToScanNodelet : public nodelet::Nodelet {
 private:
  void onInit() override {
    const auto options = loadOptions<CloudToScanStageOptions>(getPrivateNodeHandle());
    monitor_ = std::make_unique<StageMonitor>(getName());
    transforms_ = std::make_unique<TransformBuffer>(
        options.input.restart_after, loadSharedOptions(getPrivateNodeHandle()), *monitor_);
    stage_ = std::make_unique<CloudToScanStage>(options, *transforms_, *monitor_);
    ros::NodeHandle& node = getNodeHandle();
    reporter_ = std::make_unique<StageReporter>(node, getPrivateNodeHandle(), *monitor_,
                                                std::vector<std::string>{"cloud"},
                                                options.input.silence_after);
    scan_ = node.advertise<sensor_msgs::LaserScan>("scan", kQueue);
    transform_subscription_ =
        std::make_unique<TransformSubscription>(node, *transforms_, *monitor_);
    cloud_ = node.subscribe("cloud", kQueue, &CloudToScanNodelet::takeCloud, this,
                            ros::TransportHints().tcpNoDelay());
  }

  void takeCloud(const sensor_msgs::PointCloud2ConstPtr& message) {
    if (const auto output = stage_->takeCloud(*receive("cloud", message, *monitor_))) {
      if (output->mount) {
        broadcaster_.sendTransform(*output->mount);
      }
      scan_.publish(output->scan);
      reporter_->publishTiming();
    }
  }

  /// A few clouds, of several MB each: enough for a hiccup, and bounded.
  static constexpr std::uint32_t kQueue = 5;

  std::unique_ptr<StageMonitor> monitor_;
  std::unique_ptr<TransformBuffer> transforms_;
  std::unique_ptr<CloudToScanStage> stage_;
  std::unique_ptr<StageReporter> reporter_;
  std::unique_ptr<TransformSubscription> transform_subscription_;
  tf2_ros::StaticTransformBroadcaster broadcaster_;
  ros::Publisher scan_;
  ros::Subscriber cloud_;
};

}  // namespace datmo

PLUGINLIB_EXPORT_CLASS(datmo::CloudToScanNodelet, nodelet::Nodelet)
