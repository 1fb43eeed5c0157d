#include <memory>

#include <nodelet/nodelet.h>
#include <pluginlib/class_list_macros.hpp>

#include "datmo_fusion/ros/frame_ids.h"
#include "datmo_fusion/ros/parameters.h"
#include "datmo_fusion/ros/stage_reporter.h"
#include "datmo_fusion/ros/stereo_objects_stage.h"
#include "datmo_fusion/ros/transform_subscription.h"

namespace datmo {

/// The door to StereoObjectsStage. In: points2, right/camera_info, tf. Out: objects/stereo.
class StereoObjectsNodelet : public nodelet::Nodelet {
 private:
  void onInit() override {
    const auto options = loadOptions<StereoObjectsStageOptions>(getPrivateNodeHandle());
    monitor_ = std::make_unique<StageMonitor>(getName());
    transforms_ = std::make_unique<TransformBuffer>(
        options.input.restart_after, loadSharedOptions(getPrivateNodeHandle()), *monitor_);
    stage_ = std::make_unique<StereoObjectsStage>(options, *transforms_, *monitor_);
    ros::NodeHandle& node = getNodeHandle();
    reporter_ = std::make_unique<StageReporter>(node, getPrivateNodeHandle(), *monitor_,
                                                std::vector<std::string>{"points2"},
                                                options.input.silence_after);
    objects_ = node.advertise<ObjectArray>("objects/stereo", kQueue);
    transform_subscription_ =
        std::make_unique<TransformSubscription>(node, *transforms_, *monitor_);
    const auto hints = ros::TransportHints().tcpNoDelay();
    camera_info_ = node.subscribe("right/camera_info", kQueue,
                                  &StereoObjectsNodelet::takeCameraInfo, this, hints);
    points_ = node.subscribe("points2", kQueue, &StereoObjectsNodelet::takeCloud, this, hints);
  }

  void takeCameraInfo(const sensor_msgs::CameraInfoConstPtr& message) {
    stage_->takeCameraInfo(*receive("right/camera_info", message, *monitor_));
  }

  void takeCloud(const sensor_msgs::PointCloud2ConstPtr& message) {
    if (const auto objects = stage_->takeCloud(*receive("points2", message, *monitor_))) {
      objects_.publish(objects);
      reporter_->publishTiming();
    }
  }

  /// A few clouds, of several MB each: enough for a hiccup, and bounded.
  static constexpr std::uint32_t kQueue = 5;

  std::unique_ptr<StageMonitor> monitor_;
  std::unique_ptr<TransformBuffer> transforms_;
  std::unique_ptr<StereoObjectsStage> stage_;
  std::unique_ptr<StageReporter> reporter_;
  std::unique_ptr<TransformSubscription> transform_subscription_;
  ros::Publisher objects_;
  ros::Subscriber camera_info_;
  ros::Subscriber points_;
};

}  // namespace datmo

PLUGINLIB_EXPORT_CLASS(datmo::StereoObjectsNodelet, nodelet::Nodelet)
