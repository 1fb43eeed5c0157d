#include <memory>

#include <nodelet/nodelet.h>
#include <pluginlib/class_list_macros.hpp>

#include "datmo_fusion/ros/frame_ids.h"
#include "datmo_fusion/ros/parameters.h"
#include "datmo_fusion/ros/stage_reporter.h"
#include "datmo_fusion/ros/stereo_grid_stage.h"
#include "datmo_fusion/ros/transform_subscription.h"

namespace datmo {

/// The door to StereoGridStage. In: points2, right/camera_info, tf. Out: grids/stereo.
class StereoGridNodelet : public nodelet::Nodelet {
 private:
  void onInit() override {
    const auto options = loadOptions<StereoGridStageOptions>(getPrivateNodeHandle());
    monitor_ = std::make_unique<StageMonitor>(getName());
    transforms_ = std::make_unique<TransformBuffer>(
        options.input.restart_after, loadSharedOptions(getPrivateNodeHandle()), *monitor_);
    stage_ = std::make_unique<StereoGridStage>(options, *transforms_, *monitor_);
    ros::NodeHandle& node = getNodeHandle();
    reporter_ = std::make_unique<StageReporter>(node, getPrivateNodeHandle(), *monitor_,
                                                std::vector<std::string>{"points2"},
                                                options.input.silence_after);
    grid_ = node.advertise<nav_msgs::OccupancyGrid>("grids/stereo", kQueue);
    transform_subscription_ =
        std::make_unique<TransformSubscription>(node, *transforms_, *monitor_);
    const auto hints = ros::TransportHints().tcpNoDelay();
    camera_info_ = node.subscribe("right/camera_info", kQueue, &StereoGridNodelet::takeCameraInfo,
                                  this, hints);
    points_ = node.subscribe("points2", kQueue, &StereoGridNodelet::takeCloud, this, hints);
  }

  void takeCameraInfo(const sensor_msgs::CameraInfoConstPtr& message) {
    stage_->takeCameraInfo(*receive("right/camera_info", message, *monitor_));
  }

  void takeCloud(const sensor_msgs::PointCloud2ConstPtr& message) {
    if (const auto grid = stage_->takeCloud(*receive("points2", message, *monitor_))) {
      grid_.publish(grid);
      reporter_->publishTiming();
    }
  }

  /// A few clouds, of several MB each: enough for a hiccup, and bounded.
  static constexpr std::uint32_t kQueue = 5;

  std::unique_ptr<StageMonitor> monitor_;
  std::unique_ptr<TransformBuffer> transforms_;
  std::unique_ptr<StereoGridStage> stage_;
  std::unique_ptr<StageReporter> reporter_;
  std::unique_ptr<TransformSubscription> transform_subscription_;
  ros::Publisher grid_;
  ros::Subscriber camera_info_;
  ros::Subscriber points_;
};

}  // namespace datmo

PLUGINLIB_EXPORT_CLASS(datmo::StereoGridNodelet, nodelet::Nodelet)
