// SPDX-License-Identifier: BSD-3-Clause
#include <memory>
#include <string>
#include <vector>

#include <nodelet/nodelet.h>
#include <pluginlib/class_list_macros.hpp>

#include "datmo_fusion/ros/display/camera_view.h"
#include "datmo_fusion/ros/frame_ids.h"
#include "datmo_fusion/ros/parameters.h"
#include "datmo_fusion/ros/stage/guard.h"
#include "datmo_fusion/ros/stage/stage_reporter.h"
#include "datmo_fusion/ros/subscription.h"
#include "datmo_fusion/ros/transform_subscription.h"

namespace datmo {

/// ROS interface of CameraView. In: image, camera_info, tracks, tf. Out: camera_view. It subscribes
/// to the images only while it has subscribers, so that none are rectified unnecessarily.
class CameraViewNodelet : public nodelet::Nodelet {
 private:
  void onInit() override {
    const NodeletParameters parameters(getPrivateNodeHandle());
    const auto options = parameters.options<CameraViewOptions>();
    monitor_ = std::make_unique<StageMonitor>(getName());
    transforms_ = std::make_unique<TransformBuffer>(options.input.restart_after,
                                                    parameters.shared(), *monitor_);
    view_ = std::make_unique<CameraView>(options, *transforms_, *monitor_);
    ros::NodeHandle& node = getNodeHandle();
    // Without subscribers no input counts as missing.
    reporter_ = std::make_unique<StageReporter>(node, getPrivateNodeHandle(), *monitor_,
                                                std::vector<WatchedInput>{}, StageTopics{},
                                                options.input.silence_after);
    transform_subscription_ = std::make_unique<TransformSubscription>(node, *transforms_, *monitor_,
                                                                      [this] { publish(); });
    camera_info_ = Subscription::to(node, "camera_info", kQueue, *monitor_,
                                    &CameraViewNodelet::handleCameraInfo, this);
    tracks_ =
        Subscription::to(node, "tracks", kQueue, *monitor_, &CameraViewNodelet::handleTracks, this);
    const auto update = [this](const ros::SingleSubscriberPublisher& /*subscriber*/) {
      guarded(*monitor_, "camera_view", [this] { updateImageSubscription(); });
    };
    picture_ = node.advertise<sensor_msgs::Image>("camera_view", 1, update, update);
  }

  void updateImageSubscription() {
    if (picture_.getNumSubscribers() == 0) {
      images_ = Subscription();
    } else if (!images_) {
      images_ = Subscription::to(getNodeHandle(), "image", kQueue, *monitor_,
                                 &CameraViewNodelet::handleImage, this);
    }
  }

  void handleCameraInfo(const sensor_msgs::CameraInfoConstPtr& message) {
    view_->handleCameraInfo(*withPlainFrames("camera_info", message, *monitor_));
  }

  void handleTracks(const TrackArrayConstPtr& message) {
    view_->handleTracks(withPlainFrames("tracks", message, *monitor_));
    publish();
  }

  void handleImage(const sensor_msgs::ImageConstPtr& message) {
    view_->handleImage(receive("image", message, *monitor_), toStamp(ros::Time::now()));
    publish();
  }

  void publish() {
    while (const auto picture = view_->next(toStamp(ros::Time::now()))) {
      picture_.publish(picture);
      reporter_->publishTiming();
    }
  }

  /// A few images of several MB each: bounded, but enough for short delays.
  static constexpr std::uint32_t kQueue = 5;

  std::unique_ptr<StageMonitor> monitor_;
  std::unique_ptr<TransformBuffer> transforms_;
  std::unique_ptr<CameraView> view_;
  std::unique_ptr<StageReporter> reporter_;
  std::unique_ptr<TransformSubscription> transform_subscription_;
  ros::Publisher picture_;
  Subscription camera_info_;
  Subscription tracks_;
  Subscription images_;
};

}  // namespace datmo

PLUGINLIB_EXPORT_CLASS(datmo::CameraViewNodelet, nodelet::Nodelet)
