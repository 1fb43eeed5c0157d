#include <memory>

#include <nodelet/nodelet.h>
#include <pluginlib/class_list_macros.hpp>

#include "datmo_fusion/ros/moving_objects_stage.h"
#include "datmo_fusion/ros/parameters.h"
#include "datmo_fusion/ros/stage_reporter.h"

namespace datmo {

/// The door to MovingObjectsStage. In: split_scan. Out: objects.
class MovingObjectsNodelet : public nodelet::Nodelet {
 private:
  void onInit() override {
    const auto options = loadOptions<MovingObjectsStageOptions>(getPrivateNodeHandle());
    monitor_ = std::make_unique<StageMonitor>(getName());
    stage_ = std::make_unique<MovingObjectsStage>(options, *monitor_);
    ros::NodeHandle& node = getNodeHandle();
    reporter_ = std::make_unique<StageReporter>(node, getPrivateNodeHandle(), *monitor_,
                                                std::vector<std::string>{"split_scan"},
                                                options.input.silence_after);
    objects_ = node.advertise<ObjectArray>("objects", kQueue);
    split_scan_ = node.subscribe("split_scan", kQueue, &MovingObjectsNodelet::takeSplitScan, this,
                                 ros::TransportHints().tcpNoDelay());
  }

  void takeSplitScan(const SplitScanConstPtr& message) {
    monitor_->received("split_scan", toStamp(ros::Time::now()));
    if (const auto objects = stage_->takeSplitScan(*message)) {
      objects_.publish(objects);
      reporter_->publishTiming();
    }
  }

  /// A second of scans: enough for a hiccup, and bounded.
  static constexpr std::uint32_t kQueue = 20;

  std::unique_ptr<StageMonitor> monitor_;
  std::unique_ptr<MovingObjectsStage> stage_;
  std::unique_ptr<StageReporter> reporter_;
  ros::Publisher objects_;
  ros::Subscriber split_scan_;
};

}  // namespace datmo

PLUGINLIB_EXPORT_CLASS(datmo::MovingObjectsNodelet, nodelet::Nodelet)
