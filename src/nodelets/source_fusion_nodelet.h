#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <nav_msgs/Odometry.h>
#include <nodelet/nodelet.h>

#include "datmo_fusion/ros/parameters.h"
#include "datmo_fusion/ros/stage_monitor.h"
#include "datmo_fusion/ros/stage_reporter.h"
#include "datmo_fusion/ros/stamp_check.h"

namespace datmo {

/// What the doors to stages that fuse several sources have in common. In: a `Message` of each
/// source, odometry or else pose. What is ready is asked for after each message of a source, and
/// from time to time.
template <typename Stage, typename Options, typename Message>
class SourceFusionNodelet : public nodelet::Nodelet {
 protected:
  /// `topics`: the sources' messages come on `topics`/<source>.
  explicit SourceFusionNodelet(std::string topics) : topics_(std::move(topics)) {}

  /// Before the sources are heard.
  virtual void prepare(const Options& options) = 0;

  /// Hands one message to the stage. `now`: ROS time.
  virtual void take(const std::string& source, const Message& message, Stamp now) = 0;

  /// Publishes the next result, if there is one.
  virtual bool publishNext(Stamp now) = 0;

  Stage& stage() { return *stage_; }

  /// A second of messages: enough for a hiccup, and bounded.
  static constexpr std::uint32_t kQueue = 20;

  static ros::TransportHints hints() { return ros::TransportHints().tcpNoDelay(); }

 private:
  void onInit() override {
    const auto options = loadOptions<Options>(getPrivateNodeHandle());
    monitor_ = std::make_unique<StageMonitor>(getName());
    stage_ = std::make_unique<Stage>(options, *monitor_);
    std::vector<std::string> inputs;
    for (const std::string& source : stage_->sources()) {
      inputs.push_back(topicOf(source));
    }
    inputs.emplace_back(options.motion.odometry ? "odometry" : "pose");
    reporter_ = std::make_unique<StageReporter>(getNodeHandle(), getPrivateNodeHandle(), *monitor_,
                                                inputs, options.input.silence_after);
    prepare(options);
    subscribeMotion(options.motion.odometry);
    for (const std::string& source : stage_->sources()) {
      subscribe(source);
    }
    timer_ = getNodeHandle().createTimer(
        ros::Duration(kPeriod), [this](const ros::TimerEvent& /*event*/) { publishReady(); });
  }

  std::string topicOf(const std::string& source) const { return topics_ + "/" + source; }

  void subscribeMotion(bool with_odometry) {
    ros::NodeHandle& node = getNodeHandle();
    if (with_odometry) {
      motion_ =
          node.subscribe("odometry", kQueue, &SourceFusionNodelet::takeOdometry, this, hints());
    } else {
      motion_ = node.subscribe("pose", kQueue, &SourceFusionNodelet::takePose, this, hints());
    }
  }

  void subscribe(const std::string& source) {
    using MessagePtr = boost::shared_ptr<const Message>;
    const std::string topic = topicOf(source);
    const auto receive = [this, topic, source](const MessagePtr& message) {
      const Stamp now = toStamp(ros::Time::now());
      monitor_->received(topic, now);
      take(source, *message, now);
      publishReady();
    };
    ros::NodeHandle& node = getNodeHandle();
    const boost::function<void(const MessagePtr&)> callback = receive;
    sources_.push_back(
        node.subscribe<Message>(topic, kQueue, callback, ros::VoidConstPtr(), hints()));
  }

  void takeOdometry(const nav_msgs::OdometryConstPtr& message) {
    monitor_->received("odometry", toStamp(ros::Time::now()));
    stage_->takeOdometry(*message);
  }

  void takePose(const geometry_msgs::PoseWithCovarianceStampedConstPtr& message) {
    monitor_->received("pose", toStamp(ros::Time::now()));
    stage_->takePose(*message);
  }

  void publishReady() {
    while (publishNext(toStamp(ros::Time::now()))) {
      reporter_->publishTiming();
    }
  }

  /// s; how late it may be found out that a source is not waited for any more.
  static constexpr double kPeriod = 0.02;

  std::string topics_;
  std::unique_ptr<StageMonitor> monitor_;
  std::unique_ptr<Stage> stage_;
  std::unique_ptr<StageReporter> reporter_;
  ros::Subscriber motion_;
  std::vector<ros::Subscriber> sources_;
  ros::Timer timer_;
};

}  // namespace datmo
