#include <memory>

#include <nodelet/nodelet.h>
#include <pluginlib/class_list_macros.hpp>

#include "datmo_fusion/ros/moving_objects_stage.h"
#include "datmo_fusion/ros/parameters.h"
#include "datmo_fusion/ros/stage_reporter.h"

namespace datmo {

/// The door to MovingObjectsStage. In: split_scan, with `road_borders` road_borders too. Out:
/// objects, with borders objects/dropped too.
class MovingObjectsNodelet : public nodelet::Nodelet {
 private:
  void onInit() override {
    const auto options = loadOptions<MovingObjectsStageOptions>(getPrivateNodeHandle());
    monitor_ = std::make_unique<StageMonitor>(getName());
    stage_ = std::make_unique<MovingObjectsStage>(options, *monitor_);
    ros::NodeHandle& node = getNodeHandle();
    std::vector<std::string> inputs{"split_scan"};
    objects_ = node.advertise<ObjectArray>("objects", kQueue);
    if (options.road_borders) {
      inputs.emplace_back("road_borders");
      dropped_ = node.advertise<DroppedObjects>("objects/dropped", kQueue);
      road_borders_ = node.subscribe("road_borders", kQueue, &MovingObjectsNodelet::takeRoadBorders,
                                     this, ros::TransportHints().tcpNoDelay());
    }
    reporter_ = std::make_unique<StageReporter>(node, getPrivateNodeHandle(), *monitor_, inputs,
                                                options.input.silence_after);
    split_scan_ = node.subscribe("split_scan", kQueue, &MovingObjectsNodelet::takeSplitScan, this,
                                 ros::TransportHints().tcpNoDelay());
  }

  void takeSplitScan(const SplitScanConstPtr& message) {
    monitor_->received("split_scan", toStamp(ros::Time::now()));
    if (const auto found = stage_->takeSplitScan(*message)) {
      objects_.publish(found->objects);
      if (found->dropped) {
        dropped_.publish(found->dropped);
      }
      reporter_->publishTiming();
    }
  }

  void takeRoadBorders(const RoadBordersConstPtr& message) {
    monitor_->received("road_borders", toStamp(ros::Time::now()));
    stage_->takeRoadBorders(*message);
  }

  /// A second of scans: enough for a hiccup, and bounded.
  static constexpr std::uint32_t kQueue = 20;

  std::unique_ptr<StageMonitor> monitor_;
  std::unique_ptr<MovingObjectsStage> stage_;
  std::unique_ptr<StageReporter> reporter_;
  ros::Publisher objects_;
  ros::Publisher dropped_;
  ros::Subscriber split_scan_;
  ros::Subscriber road_borders_;
};

}  // namespace datmo

PLUGINLIB_EXPORT_CLASS(datmo::MovingObjectsNodelet, nodelet::Nodelet)
