#include <memory>

#include <nodelet/nodelet.h>
#include <pluginlib/class_list_macros.hpp>

#include "datmo_fusion/ros/frame_ids.h"
#include "datmo_fusion/ros/parameters.h"
#include "datmo_fusion/ros/stage_reporter.h"
#include "datmo_fusion/ros/tracker_stage.h"
#include "datmo_fusion/ros/transform_subscription.h"

namespace datmo {

/// The door to TrackerStage. In: objects, split_scan, tf. Out: tracks.
class TrackerNodelet : public nodelet::Nodelet {
 private:
  void onInit() override {
    const auto options = loadOptions<TrackerStageOptions>(getPrivateNodeHandle());
    monitor_ = std::make_unique<StageMonitor>(getName());
    transforms_ = std::make_unique<TransformBuffer>(
        options.input.restart_after, loadSharedOptions(getPrivateNodeHandle()), *monitor_);
    const Stopwatch watch;
    stage_ = std::make_unique<TrackerStage>(options, *transforms_, *monitor_,
                                            [watch] { return watch.seconds(); });
    ros::NodeHandle& node = getNodeHandle();
    reporter_ = std::make_unique<StageReporter>(node, getPrivateNodeHandle(), *monitor_,
                                                std::vector<std::string>{"objects"},
                                                options.input.silence_after);
    tracks_ = node.advertise<TrackArray>("tracks", kQueue);
    transform_subscription_ = std::make_unique<TransformSubscription>(node, *transforms_, *monitor_,
                                                                      [this] { publishTracks(); });
    const auto hints = ros::TransportHints().tcpNoDelay();
    split_scan_ = node.subscribe("split_scan", kQueue, &TrackerNodelet::takeSplitScan, this, hints);
    objects_ = node.subscribe("objects", kQueue, &TrackerNodelet::takeObjects, this, hints);
  }

  void takeSplitScan(const SplitScanConstPtr& message) {
    stage_->takeSplitScan(*withPlainFrames("split_scan", message, *monitor_));
    publishTracks();
  }

  void takeObjects(const ObjectArrayConstPtr& message) {
    stage_->takeObjects(receive("objects", message, *monitor_), toStamp(ros::Time::now()));
    publishTracks();
  }

  void publishTracks() {
    while (const auto tracks = stage_->next(toStamp(ros::Time::now()))) {
      tracks_.publish(tracks);
      reporter_->publishTiming();
    }
  }

  /// A second of objects: enough for a hiccup, and bounded.
  static constexpr std::uint32_t kQueue = 20;

  std::unique_ptr<StageMonitor> monitor_;
  std::unique_ptr<TransformBuffer> transforms_;
  std::unique_ptr<TrackerStage> stage_;
  std::unique_ptr<StageReporter> reporter_;
  ros::Publisher tracks_;
  std::unique_ptr<TransformSubscription> transform_subscription_;
  ros::Subscriber split_scan_;
  ros::Subscriber objects_;
};

}  // namespace datmo

PLUGINLIB_EXPORT_CLASS(datmo::TrackerNodelet, nodelet::Nodelet)
