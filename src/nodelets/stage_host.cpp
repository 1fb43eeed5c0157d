// SPDX-License-Identifier: BSD-3-Clause
#include "stage_host.h"

#include <string>
#include <utility>

#include "datmo_fusion/ros/stage/guard.h"

namespace datmo {

namespace {

/// s; maximum delay in noticing that a message need not be waited for any longer.
constexpr double kPollPeriod = 0.02;

}  // namespace

StageHost::StageHost(ros::NodeHandle node, ros::NodeHandle private_node, Stage& stage,
                     StageMonitor& monitor, TransformBuffer* transforms, double silence_after)
    : node_(std::move(node)),
      private_node_(std::move(private_node)),
      stage_(stage),
      monitor_(monitor) {
  stage_.connect(*this);
  const auto resolved = [this](const std::string& topic) { return node_.resolveName(topic); };
  const StageTopics topics = topicsOf(inputs_, outputs_, resolved);
  if (!stage_.live().empty()) {
    live_ = std::make_unique<LiveServer>(
        private_node_, monitor_, [this] { return stage_.live(); },
        [this](const OptionValues& values) { stage_.change(values); });
  }
  reporter_ = std::make_unique<StageReporter>(
      node_, private_node_, monitor_, watchedInputs(inputs_, resolved), topics, silence_after);
  if (transforms != nullptr) {
    transforms_ = std::make_unique<TransformSubscription>(node_, *transforms, monitor_,
                                                          [this] { publishReady(); });
  }
  for (const StageInput& input : inputs_) {
    subscribe(input);
  }
  if (stage_.maxWait() > 0.0) {
    timer_ =
        node_.createTimer(ros::Duration(kPollPeriod), [this](const ros::TimerEvent& /*event*/) {
          guarded(monitor_, "timer", [this] { publishReady(); });
        });
  }
}

void StageHost::addInput(StageInput input) { inputs_.push_back(std::move(input)); }

StageOutput::Publish StageHost::addOutput(StageOutput output) {
  // A result counts as published with its first message: time for further output (the map) is not
  // included.
  outputs_.push_back(output.topic);
  return
      [this, publish = output.advertise(node_), content = output.content,
       check = std::make_shared<OutputCheck>(output.topic, monitor_)](const AnyMessage& message) {
        if (check->passes(content(message))) {
          publish(message);
          publishTiming();
        }
      };
}

void StageHost::addService(StageService service) {
  services_.push_back(service.advertise(private_node_, monitor_));
}

void StageHost::subscribe(const StageInput& input) {
  const auto callback = [this, input](const AnyMessage& message, Stamp now) {
    input.callback(message, now);
    publishTiming();
    publishReady();
  };
  subscriptions_.push_back(input.subscribe(node_, monitor_, callback));
}

void StageHost::publishReady() {
  while (stage_.publishNext(toStamp(ros::Time::now()))) {
    publishTiming();
  }
}

void StageHost::publishTiming() {
  if (monitor_.processedCount() > timed_) {
    timed_ = monitor_.processedCount();
    reporter_->publishTiming();
  }
}

}  // namespace datmo
