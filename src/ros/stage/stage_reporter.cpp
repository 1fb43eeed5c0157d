// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/stage/stage_reporter.h"

#include <chrono>
#include <iterator>
#include <sstream>
#include <utility>

#include <boost/make_shared.hpp>

#include <ros/console.h>

#include "datmo_fusion/ros/convert/messages.h"
#include "datmo_fusion/ros/stage/guard.h"
#include "datmo_fusion/ros/stage/stamp_check.h"

namespace datmo {

namespace {

using diagnostic_msgs::DiagnosticStatus;
using diagnostic_updater::DiagnosticStatusWrapper;

constexpr double kDiagnosticsPeriod = 1.0;  // s, usual for /diagnostics
constexpr std::uint32_t kTimingQueue = 50;  // several stages for about a second

/// How long the stage waits for an answer of the master: it usually comes within some milliseconds.
constexpr std::chrono::milliseconds kMasterPatience(50);

std::string joinNames(const std::vector<std::string>& topics) {
  std::string text;
  for (const std::string& topic : topics) {
    text += (text.empty() ? "" : " ") + topic;
  }
  return text;
}

std::vector<std::string> split(const std::string& text) {
  std::istringstream words(text);
  return {std::istream_iterator<std::string>(words), {}};
}

/// Keys of a status that stateOf() reads.
constexpr char kInputs[] = "inputs";
constexpr char kOutputs[] = "outputs";
constexpr char kCause[] = "first cause";

double milliseconds(double seconds) { return 1e3 * seconds; }

}  // namespace

unsigned char diagnosticLevel(HealthLevel level) {
  switch (level) {
    case HealthLevel::kNoOutput:
      return DiagnosticStatus::ERROR;
    case HealthLevel::kDegraded:
      return DiagnosticStatus::WARN;
    case HealthLevel::kOk:
      break;
  }
  return DiagnosticStatus::OK;
}

std::optional<StageState> stateOf(const DiagnosticStatus& status) {
  StageState state;
  state.stage = status.name.substr(0, status.name.find(':'));
  state.level = status.level >= DiagnosticStatus::ERROR  ? HealthLevel::kNoOutput
                : status.level == DiagnosticStatus::WARN ? HealthLevel::kDegraded
                                                         : HealthLevel::kOk;
  bool is_stage = false;
  for (const diagnostic_msgs::KeyValue& entry : status.values) {
    if (entry.key == kInputs) {
      state.topics.inputs = split(entry.value);
    } else if (entry.key == kOutputs) {
      state.topics.outputs = split(entry.value);
      is_stage = true;
    } else if (entry.key == kCause && !entry.value.empty()) {
      state.faults = {entry.value};
    }
  }
  return is_stage ? std::make_optional(state) : std::nullopt;
}

StageReporter::StageReporter(ros::NodeHandle node, ros::NodeHandle private_node,
                             StageMonitor& monitor, std::vector<WatchedInput> inputs,
                             StageTopics topics, double silence_after)
    : monitor_(monitor),
      inputs_(std::move(inputs)),
      topics_(std::move(topics)),
      health_(inputs_, silence_after),
      progress_(inputs_),
      timing_(node.advertise<StageTiming>("timing", kTimingQueue)),
      updater_(node, private_node, private_node.getNamespace()) {
  updater_.setHardwareID("none");
  updater_.add("stage", [this](DiagnosticStatusWrapper& status) { diagnose(status); });
  timer_ = node.createSteadyTimer(ros::WallDuration(kDiagnosticsPeriod),
                                  [this](const ros::SteadyTimerEvent&) {
                                    // Without news there are still diagnostics.
                                    guarded(monitor_, "timer", [this] { logChanges(); });
                                    guarded(monitor_, "timer", [this] { updater_.force_update(); });
                                  });
}

PublishedType StageReporter::askMaster() {
  return [this, asked = false](const std::string& topic) mutable -> std::optional<std::string> {
    if (!std::exchange(asked, true)) {
      published_.update(kMasterPatience);
    }
    return published_.typeOf(topic);
  };
}

void StageReporter::logChanges() {
  const char* const stage = monitor_.stage().c_str();
  const double seconds = since_start_.seconds();
  for (const InputProgress::Line& line : progress_.news(monitor_, seconds, askMaster())) {
    ROS_LOG(line.is_warning ? ros::console::levels::Warn : ros::console::levels::Info,
            ROSCONSOLE_DEFAULT_NAME, "%s: %s", stage, line.text.c_str());
  }
  for (const std::string& text : monitor_.handleAnnouncements()) {
    ROS_INFO("%s: %s", stage, text.c_str());
  }
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
  const StageState state = health_.judge(monitor_, toStamp(ros::Time::now()), askMaster());
  status.summary(diagnosticLevel(state.level), state.faults.empty() ? "runs" : "");
  for (const std::string& fault : state.faults) {
    status.message += (status.message.empty() ? "" : "; ") + fault;
  }
  listInputs(status);
  listCounts(status);
  status.add(kCause, state.faults.empty() ? "" : state.faults.front());
  status.add(kInputs, joinNames(topics_.inputs));
  status.add(kOutputs, joinNames(topics_.outputs));
}

void StageReporter::listInputs(DiagnosticStatusWrapper& status) const {
  for (const WatchedInput& watched : inputs_) {
    const InputStatus input = monitor_.input(watched.name, toStamp(ros::Time::now()));
    status.add(watched.name + " received", input.received);
    status.addf(watched.name + " rate [Hz]", "%.1f", input.rate);
    if (input.silence) {
      status.addf(watched.name + " age [s]", "%.2f", *input.silence);
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
