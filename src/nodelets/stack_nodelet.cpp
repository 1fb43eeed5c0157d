// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cstdlib>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "restart_argument.h"

#include <diagnostic_msgs/DiagnosticArray.h>
#include <diagnostic_updater/diagnostic_updater.h>
#include <nodelet/nodelet.h>
#include <pluginlib/class_list_macros.hpp>
#include <std_msgs/Time.h>

#include "datmo_fusion/ros/parameters.h"
#include "datmo_fusion/ros/stage/guard.h"
#include "datmo_fusion/ros/stage/part_clocks.h"
#include "datmo_fusion/ros/stage/stack_health.h"
#include "datmo_fusion/ros/stage/stage_reporter.h"
#include "datmo_fusion/ros/stage/stamp_check.h"
#include "datmo_fusion/ros/subscription.h"

namespace datmo {

/// Reports the health of the stack in one sentence and, if there is no output, the first cause in
/// the chain. In: /diagnostics of the stages, and the topic `tracks` for its name. Out: its own
/// status in /diagnostics, and a line on the console when it changes.
///
/// Queries the clocks of the parts that run on other machines: out clock_question, in clock_answer.
class StackNodelet : public nodelet::Nodelet {
 private:
  using DiagnosticStatus = diagnostic_msgs::DiagnosticStatus;

  void onInit() override {
    monitor_ = std::make_unique<StageMonitor>(getName());
    result_ = getNodeHandle().resolveName("tracks");
    restarts_ = restartsIn(getMyArgv());
    clocks_ = std::make_unique<PartClocks>(loadOptions<PartClocksOptions>(getPrivateNodeHandle()));
    timer_ = getNodeHandle().createSteadyTimer(ros::WallDuration(kPeriod),
                                               [this](const ros::SteadyTimerEvent&) {
                                                 guarded(*monitor_, "timer", [this] {
                                                   connect();
                                                   updater_->force_update();
                                                   askClocks();
                                                 });
                                               });
  }

  /// In a callback instead of onInit(): the process loads one nodelet after the other, and the
  /// stages need not wait until the master has answered this one.
  void connect() {
    if (updater_) {
      return;
    }
    diagnostics_ = Subscription::to(getNodeHandle(), "/diagnostics", kQueue, *monitor_,
                                    &StackNodelet::handleDiagnostics, this);
    questions_ = getNodeHandle().advertise<std_msgs::Time>("clock_question", 1);
    answers_ = Subscription::to(getNodeHandle(), "clock_answer", kQueue, *monitor_,
                                &StackNodelet::handleAnswer, this);
    updater_ = std::make_unique<diagnostic_updater::Updater>(
        getNodeHandle(), getPrivateNodeHandle(), getPrivateNodeHandle().getNamespace());
    updater_->setHardwareID("none");
    updater_->add("stack",
                  [this](diagnostic_updater::DiagnosticStatusWrapper& status) { report(status); });
  }

  static int restartsIn(const std::vector<std::string>& arguments) {
    const auto found = std::find(arguments.begin(), arguments.end(), kRestartsArgument);
    return arguments.end() - found < 2 ? 0 : std::atoi((found + 1)->c_str());
  }

  /// The machine's wall clock: message time may be that of a bag.
  static ros::Time machineTime() {
    const ros::WallTime now = ros::WallTime::now();
    return {now.sec, now.nsec};
  }

  void askClocks() {
    std_msgs::Time question;
    question.data = machineTime();
    questions_.publish(question);
  }

  void handleAnswer(const PartClockConstPtr& answer) {
    clocks_->addAnswer(*answer, toStamp(machineTime()));
  }

  void handleDiagnostics(const diagnostic_msgs::DiagnosticArrayConstPtr& list) {
    for (const DiagnosticStatus& status : list->status) {
      if (const auto state = stateOf(status)) {
        stages_.update(*state, since_start_.seconds());
      }
    }
  }

  void report(diagnostic_updater::DiagnosticStatusWrapper& status) {
    const Stamp now = toStamp(machineTime());
    const double running = since_start_.seconds();
    const StackHealth health = withRestart(
        clocks_->judged(stackHealth(stages_.at(running), result_), now), restarts_, running);
    status.summary(diagnosticLevel(health.level), health.sentence);
    status.add("restarts of its process", restarts_);
    for (const auto& [process, description] : clocks_->descriptions(now)) {
      status.add("clock of " + process, description);
    }
    const bool may_come_yet =
        !reported_ && health.level != HealthLevel::kOk && ++beats_ < kPatience;
    if (health.level != reported_ && !may_come_yet) {
      reported_ = health.level;
      const bool is_good = health.level == HealthLevel::kOk;
      ROS_LOG(is_good ? ros::console::levels::Info : ros::console::levels::Warn,
              ROSCONSOLE_DEFAULT_NAME, "stack: %s", health.sentence.c_str());
    }
  }

  static constexpr double kPeriod = 1.0;       ///< s, like all diagnostics
  static constexpr int kPatience = 6;          ///< periods before missing input is reported
  static constexpr std::uint32_t kQueue = 50;  ///< several stages for about a second

  std::unique_ptr<StageMonitor> monitor_;
  std::string result_;
  ReportingStages stages_;
  std::unique_ptr<PartClocks> clocks_;
  Stopwatch since_start_;
  int restarts_ = 0;
  std::optional<HealthLevel> reported_;
  int beats_ = 0;
  std::unique_ptr<diagnostic_updater::Updater> updater_;
  Subscription diagnostics_;
  ros::Publisher questions_;
  Subscription answers_;
  ros::SteadyTimer timer_;
};

}  // namespace datmo

PLUGINLIB_EXPORT_CLASS(datmo::StackNodelet, nodelet::Nodelet)
