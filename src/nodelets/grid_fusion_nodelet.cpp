#include <memory>

#include <datmo_fusion/GridFusionConfig.h>
#include <dynamic_reconfigure/server.h>

#include <nodelet/nodelet.h>
#include <pluginlib/class_list_macros.hpp>

#include "datmo_fusion/ros/grid_fusion_stage.h"
#include "datmo_fusion/ros/parameters.h"
#include "datmo_fusion/ros/stage_reporter.h"

namespace datmo {

/// The door to GridFusionStage. In: grids/<source> of each source, odometry or else pose. Out:
/// grids/fused, grids/conflict. The rule of fusion may be changed by dynamic_reconfigure.
class GridFusionNodelet : public nodelet::Nodelet {
 private:
  using Config = datmo_fusion::GridFusionConfig;

  void onInit() override {
    const auto options = loadOptions<GridFusionStageOptions>(getPrivateNodeHandle());
    monitor_ = std::make_unique<StageMonitor>(getName());
    stage_ = std::make_unique<GridFusionStage>(options, *monitor_);
    rule_ = options.fuser.rule;
    std::vector<std::string> inputs;
    for (const std::string& source : stage_->sources()) {
      inputs.push_back(topicOf(source));
    }
    inputs.emplace_back(options.motion.odometry ? "odometry" : "pose");
    reporter_ = std::make_unique<StageReporter>(getNodeHandle(), getPrivateNodeHandle(), *monitor_,
                                                inputs, options.input.silence_after);
    fused_ = getNodeHandle().advertise<nav_msgs::OccupancyGrid>("grids/fused", kQueue);
    conflict_ = getNodeHandle().advertise<nav_msgs::OccupancyGrid>("grids/conflict", kQueue);
    subscribe(options.motion.odometry);
    reconfigure_ = std::make_unique<dynamic_reconfigure::Server<Config>>(getPrivateNodeHandle());
    reconfigure_->setCallback([this](Config& config, std::uint32_t /*level*/) { setRule(config); });
  }

  static std::string topicOf(const std::string& source) { return "grids/" + source; }

  void subscribe(bool with_odometry) {
    ros::NodeHandle& node = getNodeHandle();
    const auto hints = ros::TransportHints().tcpNoDelay();
    if (with_odometry) {
      motion_ = node.subscribe("odometry", kQueue, &GridFusionNodelet::takeOdometry, this, hints);
    } else {
      motion_ = node.subscribe("pose", kQueue, &GridFusionNodelet::takePose, this, hints);
    }
    using Callback = boost::function<void(const nav_msgs::OccupancyGridConstPtr&)>;
    for (const std::string& source : stage_->sources()) {
      const Callback take = [this, source](const nav_msgs::OccupancyGridConstPtr& message) {
        takeGrid(source, *message);
      };
      grids_.push_back(node.subscribe<nav_msgs::OccupancyGrid>(topicOf(source), kQueue, take,
                                                               ros::VoidConstPtr(), hints));
    }
    timer_ = node.createTimer(ros::Duration(kPeriod),
                              [this](const ros::TimerEvent& /*event*/) { publishFused(); });
  }

  void takeOdometry(const nav_msgs::OdometryConstPtr& message) {
    monitor_->received("odometry", toStamp(ros::Time::now()));
    stage_->takeOdometry(*message);
  }

  void takePose(const geometry_msgs::PoseWithCovarianceStampedConstPtr& message) {
    monitor_->received("pose", toStamp(ros::Time::now()));
    stage_->takePose(*message);
  }

  void takeGrid(const std::string& source, const nav_msgs::OccupancyGrid& message) {
    const Stamp now = toStamp(ros::Time::now());
    monitor_->received(topicOf(source), now);
    stage_->takeGrid(source, message, now);
    publishFused();
  }

  void publishFused() {
    while (const auto output = stage_->next(toStamp(ros::Time::now()))) {
      fused_.publish(output->fused);
      conflict_.publish(output->conflict);
      reporter_->publishTiming();
    }
  }

  void setRule(Config& config) {
    try {
      stage_->setRule(config.rule);
      rule_ = config.rule;
    } catch (const OptionError& error) {
      NODELET_ERROR("%s; goes on with %s", error.what(), rule_.c_str());
      config.rule = rule_;
    }
  }

  /// A second of grids or odometry: enough for a hiccup, and bounded.
  static constexpr std::uint32_t kQueue = 20;

  /// s; how late it may be found out that a source is not waited for any more.
  static constexpr double kPeriod = 0.02;

  std::unique_ptr<StageMonitor> monitor_;
  std::unique_ptr<GridFusionStage> stage_;
  std::unique_ptr<StageReporter> reporter_;
  std::unique_ptr<dynamic_reconfigure::Server<Config>> reconfigure_;
  std::string rule_;  ///< by its name
  ros::Publisher fused_;
  ros::Publisher conflict_;
  ros::Subscriber motion_;
  std::vector<ros::Subscriber> grids_;
  ros::Timer timer_;
};

}  // namespace datmo

PLUGINLIB_EXPORT_CLASS(datmo::GridFusionNodelet, nodelet::Nodelet)
