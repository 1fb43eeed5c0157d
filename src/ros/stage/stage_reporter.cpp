// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/stage/stage_reporter.h"

#include <algorithm>

#include <boost/make_shared.hpp>

#include <diagnostic_msgs/DiagnosticStatus.h>
#include <ros/console.h>
#include <ros/master.h>

#include "datmo_fusion/ros/convert/messages.h"
#include "datmo_fusion/ros/stage/stamp_check.h"

namespace datmo {

namespace {

using diagnostic_msgs::DiagnosticStatus;
using diagnostic_updater::DiagnosticStatusWrapper;

constexpr double kDiagnosticsPeriod = 1.0;  // s, the custom of /diagnostics
constexpr std::uint32_t kTimingQueue = 50;  // several stages for a second or so

/// Topics of `inputs` by their resolved names.
InputProgress::Topics topicsOf(const ros::NodeHandle& node,
                               const std::vector<std::string>& inputs) {
  InputProgress::Topics topics;
  for (const std::string& input : inputs) {
    topics[input] = {node.resolveName(input)};
  }
  return topics;
}

bool isPublished(const std::string& topic) {
  ros::master::V_TopicInfo published;
  ros::master::getTopics(published);
  return std::any_of(published.begin(), published.end(),
                     [&](const ros::master::TopicInfo& each) { return each.name == topic; });
}

double milliseconds(double seconds) { return 1e3 * seconds; }

}  // namespace

StageReporter::StageReporter(ros::NodeHandle node, ros::NodeHandle private_node,
                             StageMonitor& monitor, std::vector<std::string> inputs,
                             double silence_after)
    : monitor_(monitor),
      inputs_(std::move(inputs)),
      silence_after_(silence_after),
      progress_(topicsOf(node, inputs_)),
      timing_(node.advertise<StageTiming>("timing", kTimingQueue)),
      updater_(node, private_node, private_node.getNamespace()) {
  updater_.setHardwareID("none");
  updater_.add("stage", [this](DiagnosticStatusWrapper& status) { diagnose(status); });
  timer_ = node.createSteadyTimer(ros::WallDuration(kDiagnosticsPeriod),
                                  [this](const ros::SteadyTimerEvent&) {
                                    sayNews();
                                    updater_.force_update();
                                  });
}

void StageReporter::sayNews() {
  const char* const stage = monitor_.stage().c_str();
  const double seconds = since_start_.seconds();
  for (const InputProgress::Line& line : progress_.news(monitor_, seconds, isPublished)) {
    ROS_LOG(line.is_warning ? ros::console::levels::Warn : ros::console::levels::Info,
            ROSCONSOLE_DEFAULT_NAME, "%s: %s", stage, line.text.c_str());
  }
  for (const std::string& text : monitor_.takeAnnouncements()) {
    ROS_INFO("%s: %s", stage, text.c_str());
  }
}

void StageReporter::alsoOn(const std::string& input, const std::string& topic) {
  progress_.addTopic(input, topic);
}

void StageReporter::publishTiming() {
  const Processed& last = monitor_.lastProcessed();
  const auto message = boost::make_shared<StageTiming>();
  message->header.stamp = toTime(last.stamp);
  message->stage = monitor_.stage();
  message->processing_time = last.seconds;
  message->latency = secondsBetween(last.stamp, toStamp(ros::Time::now()));
  last_latency_ = message->latency;
  timing_.publish(message);
}

void StageReporter::diagnose(DiagnosticStatusWrapper& status) {
  status.summary(DiagnosticStatus::OK, "runs");
  diagnoseInputs(status);
  diagnoseErrors(status);
  listCounts(status);
}

void StageReporter::diagnoseErrors(DiagnosticStatusWrapper& status) {
  const std::uint64_t errors = monitor_.droppedCount() + monitor_.warningCount();
  if (errors > reported_errors_) {
    status.mergeSummary(DiagnosticStatus::WARN, monitor_.lastError());
  }
  reported_errors_ = errors;
}

void StageReporter::diagnoseInputs(DiagnosticStatusWrapper& status) const {
  for (const std::string& name : inputs_) {
    const InputStatus input = monitor_.input(name, toStamp(ros::Time::now()));
    status.add(name + " received", input.received);
    status.addf(name + " rate [Hz]", "%.1f", input.rate);
    if (input.silence) {
      status.addf(name + " age [s]", "%.2f", *input.silence);
    }
    if (!input.silence) {
      status.mergeSummaryf(DiagnosticStatus::WARN, "no %s yet", name.c_str());
    } else if (*input.silence > silence_after_) {
      status.mergeSummaryf(DiagnosticStatus::WARN, "no %s for %.1f s", name.c_str(),
                           *input.silence);
    }
  }
}

void StageReporter::listCounts(DiagnosticStatusWrapper& status) const {
  const TimingStatus timing = monitor_.timing();
  status.add("processed", monitor_.processedCount());
  if (last_latency_) {
    status.addf("latency, last [ms]", "%.1f", milliseconds(*last_latency_));
  }
  status.addf("processing time, median [ms]", "%.2f", milliseconds(timing.median));
  status.addf("processing time, 99th percentile [ms]", "%.2f", milliseconds(timing.percentile_99));
  status.addf("processing time, most [ms]", "%.2f", milliseconds(timing.max));
  for (const auto& [name, value] : monitor_.figures()) {
    status.addf(name, "%.4g", value);
  }
  status.add("dropped", monitor_.droppedCount());
  for (const auto& [reason, count] : monitor_.drops()) {
    status.add("dropped: " + reason, count);
  }
  for (const auto& [reason, count] : monitor_.warnings()) {
    status.add("warned: " + reason, count);
  }
  status.add("last error", monitor_.lastError());
}

}  // namespace datmo
