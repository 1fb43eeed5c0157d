#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <nodelet/nodelet.h>

#include "datmo_fusion/ros/frame_ids.h"
#include "datmo_fusion/ros/parameters.h"
#include "datmo_fusion/ros/stage_monitor.h"
#include "datmo_fusion/ros/stage_reporter.h"
#include "datmo_fusion/ros/stamp_check.h"

namespace datmo {

/// What the doors to stages that fuse several sources have in common. In: a `Message` of each
/// source. What is ready is asked for after each message of a source, and from time to time.
template <typename Stage, typename Options, typename Message>
class SourceFusionNodelet : public nodelet::Nodelet {
 protected:
  /// `topics`: the sources' messages come on `topics`/<source>.
  explicit SourceFusionNodelet(std::string topics) : topics_(std::move(topics)) {}

  /// Before the sources are heard.
  virtual void prepare(const Options& options) = 0;

  /// Topics besides those of the sources, which are missed too if they are silent.
  virtual std::vector<std::string> otherInputs(const Options& /*options*/) const { return {}; }
  virtual void subscribeOthers(const Options& /*options*/) {}

  /// Hands one message to the stage. `now`: ROS time.
  virtual void take(const std::string& source, const Message& message, Stamp now) = 0;

  /// Publishes the next result, if there is one.
  virtual bool publishNext(Stamp now) = 0;

  Stage& stage() { return *stage_; }
  StageMonitor& monitor() { return *monitor_; }

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
    const std::vector<std::string> others = otherInputs(options);
    inputs.insert(inputs.end(), others.begin(), others.end());
    reporter_ = std::make_unique<StageReporter>(getNodeHandle(), getPrivateNodeHandle(), *monitor_,
                                                inputs, options.input.silence_after);
    prepare(options);
    subscribeOthers(options);
    for (const std::string& source : stage_->sources()) {
      subscribe(source);
    }
    timer_ = getNodeHandle().createTimer(
        ros::Duration(kPeriod), [this](const ros::TimerEvent& /*event*/) { publishReady(); });
  }

  std::string topicOf(const std::string& source) const { return topics_ + "/" + source; }

  void subscribe(const std::string& source) {
    using MessagePtr = boost::shared_ptr<const Message>;
    const std::string topic = topicOf(source);
    const auto handle = [this, topic, source](const MessagePtr& message) {
      take(source, *receive(topic, message, *monitor_), toStamp(ros::Time::now()));
      publishReady();
    };
    ros::NodeHandle& node = getNodeHandle();
    const boost::function<void(const MessagePtr&)> callback = handle;
    sources_.push_back(
        node.subscribe<Message>(topic, kQueue, callback, ros::VoidConstPtr(), hints()));
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
  std::vector<ros::Subscriber> sources_;
  ros::Timer timer_;
};

}  // namespace datmo
