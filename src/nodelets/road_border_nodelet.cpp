#include <memory>

#include <nodelet/nodelet.h>
#include <pluginlib/class_list_macros.hpp>

#include "datmo_fusion/ros/parameters.h"
#include "datmo_fusion/ros/road_border_stage.h"
#include "datmo_fusion/ros/stage_reporter.h"

namespace datmo {

/// The door to RoadBorderStage. In: split_scan. Out: road_borders.
class RoadBorderNodelet : public nodelet::Nodelet {
 private:
  void onInit() override {
    const auto options = loadOptions<RoadBorderStageOptions>(getPrivateNodeHandle());
    monitor_ = std::make_unique<StageMonitor>(getName());
    stage_ = std::make_unique<RoadBorderStage>(options, *monitor_);
    ros::NodeHandle& node = getNodeHandle();
    reporter_ = std::make_unique<StageReporter>(node, getPrivateNodeHandle(), *monitor_,
                                                std::vector<std::string>{"split_scan"},
                                                options.input.silence_after);
    borders_ = node.advertise<RoadBorders>("road_borders", kQueue);
    split_scan_ = node.subscribe("split_scan", kQueue, &RoadBorderNodelet::takeSplitScan, this,
                                 ros::TransportHints().tcpNoDelay());
  }

  void takeSplitScan(const SplitScanConstPtr& message) {
    monitor_->received("split_scan", toStamp(ros::Time::now()));
    if (const auto borders = stage_->takeSplitScan(*message)) {
      borders_.publish(borders);
      reporter_->publishTiming();
    }
  }

  /// A second of scans: enough for a hiccup, and bounded.
  static constexpr std::uint32_t kQueue = 20;

  std::unique_ptr<StageMonitor> monitor_;
  std::unique_ptr<RoadBorderStage> stage_;
  std::unique_ptr<StageReporter> reporter_;
  ros::Publisher borders_;
  ros::Subscriber split_scan_;
};

}  // namespace datmo

PLUGINLIB_EXPORT_CLASS(datmo::RoadBorderNodelet, nodelet::Nodelet)
