// SPDX-License-Identifier: BSD-3-Clause
#include "stage_host.h"

#include <atomic>
#include <functional>
#include <future>
#include <string>
#include <utility>

#include "datmo_fusion/ros/stage/guard.h"

namespace datmo {

namespace {

/// s; maximum delay in noticing that a message need not be waited for any longer.
constexpr double kPollPeriod = 0.02;

/// Connections to the master. On a network that loses packets, each further one may cost more than
/// it saves: it takes a second to begin if its first packet is lost.
constexpr int kConnections = 3;

/// Calls functions that mostly wait for the master, in parallel.
void callAll(const std::vector<std::function<void()>>& functions) {
  std::atomic<std::size_t> next{0};
  const auto work = [&functions, &next] {
    for (std::size_t i = next++; i < functions.size(); i = next++) {
      functions[i]();
    }
  };
  std::vector<std::future<void>> others;
  for (int i = 1; i < kConnections; ++i) {
    others.push_back(std::async(std::launch::async, work));
  }
  work();
  for (std::future<void>& other : others) {
    other.get();
  }
}

}  // namespace

StageHost::StageHost(ros::NodeHandle node, ros::NodeHandle private_node, Stage& stage,
                     StageMonitor& monitor, TransformBuffer* transforms, double silence_after)
    : node_(std::move(node)),
      private_node_(std::move(private_node)),
      stage_(stage),
      monitor_(monitor) {
  stage_.connect(*this);
  std::vector<std::function<void()>> announcements = {
      [this] { offerLiveOptions(); }, [this, silence_after] { beginReports(silence_after); }};
  announcements.insert(announcements.end(), announcements_.begin(), announcements_.end());
  callAll(announcements);
  announcements_.clear();
  // From here on there are callbacks, and they use all of the above. Not in parallel to it, either:
  // if publisher and subscriber of a topic in one process begin at the same time, roscpp may
  // connect them twice.
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

void StageHost::offerLiveOptions() {
  if (!stage_.live().empty()) {
    live_ = std::make_unique<LiveServer>(
        private_node_, monitor_, [this] { return stage_.live(); },
        [this](const OptionValues& values) { stage_.change(values); });
  }
}

void StageHost::beginReports(double silence_after) {
  const auto resolved = [this](const std::string& topic) { return node_.resolveName(topic); };
  reporter_ = std::make_unique<StageReporter>(node_, private_node_, monitor_,
                                              watchedInputs(inputs_, resolved),
                                              topicsOf(inputs_, outputs_, resolved), silence_after);
}

void StageHost::addInput(StageInput input) { inputs_.push_back(std::move(input)); }

StageOutput::Publish StageHost::addOutput(StageOutput output) {
  // A result counts as published with its first message: time for further output (the map) is not
  // included.
  outputs_.push_back(output.topic);
  const auto publish = std::make_shared<StageOutput::Publish>();
  announcements_.emplace_back(
      [this, publish, advertise = output.advertise] { *publish = advertise(node_); });
  return
      [this, publish, content = output.content,
       check = std::make_shared<OutputCheck>(output.topic, monitor_)](const AnyMessage& message) {
        if (check->passes(content(message))) {
          (*publish)(message);
          publishTiming();
        }
      };
}

void StageHost::addService(StageService service) {
  const auto server = std::make_shared<ros::ServiceServer>();
  services_.push_back(server);
  announcements_.emplace_back([this, server, advertise = service.advertise] {
    *server = advertise(private_node_, monitor_);
  });
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
