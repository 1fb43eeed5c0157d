// SPDX-License-Identifier: BSD-3-Clause
#include <memory>
#include <optional>
#include <string>

#include <diagnostic_msgs/DiagnosticArray.h>
#include <diagnostic_updater/diagnostic_updater.h>
#include <nodelet/nodelet.h>
#include <pluginlib/class_list_macros.hpp>

#include "datmo_fusion/ros/stage/stack_health.h"
#include "datmo_fusion/ros/stage/stage_reporter.h"

namespace datmo {

/// Says in one sentence how the stack does, and if nothing comes out of it, why: the first cause in
/// the chain. In: /diagnostics of the stages, and the topic `tracks` for its name. Out: a status of
/// its own in /diagnostics, and a line on the console when it changes.
class StackNodelet : public nodelet::Nodelet {
 private:
  using DiagnosticStatus = diagnostic_msgs::DiagnosticStatus;

  void onInit() override {
    result_ = getNodeHandle().resolveName("tracks");
    updater_ = std::make_unique<diagnostic_updater::Updater>(
        getNodeHandle(), getPrivateNodeHandle(), getPrivateNodeHandle().getNamespace());
    updater_->setHardwareID("none");
    updater_->add("stack",
                  [this](diagnostic_updater::DiagnosticStatusWrapper& status) { report(status); });
    diagnostics_ =
        getNodeHandle().subscribe("/diagnostics", kQueue, &StackNodelet::takeDiagnostics, this);
    timer_ = getNodeHandle().createSteadyTimer(
        ros::WallDuration(kPeriod),
        [this](const ros::SteadyTimerEvent&) { updater_->force_update(); });
  }

  void takeDiagnostics(const diagnostic_msgs::DiagnosticArrayConstPtr& list) {
    for (const DiagnosticStatus& status : list->status) {
      if (const auto state = stateOf(status)) {
        stages_.take(*state, since_start_.seconds());
      }
    }
  }

  void report(diagnostic_updater::DiagnosticStatusWrapper& status) {
    const StackHealth health = stackHealth(stages_.at(since_start_.seconds()), result_);
    status.summary(diagnosticLevel(health.level), health.sentence);
    const bool may_come_yet = !said_ && health.level != HealthLevel::kGood && ++beats_ < kPatience;
    if (health.level != said_ && !may_come_yet) {
      said_ = health.level;
      const bool is_good = health.level == HealthLevel::kGood;
      ROS_LOG(is_good ? ros::console::levels::Info : ros::console::levels::Warn,
              ROSCONSOLE_DEFAULT_NAME, "stack: %s", health.sentence.c_str());
    }
  }

  static constexpr double kPeriod = 1.0;       ///< s, as of all diagnostics
  static constexpr int kPatience = 6;          ///< beats: what is missing at the start is no news
  static constexpr std::uint32_t kQueue = 50;  ///< several stages for a second or so

  std::string result_;
  ReportingStages stages_;
  Stopwatch since_start_;
  std::optional<HealthLevel> said_;
  int beats_ = 0;
  std::unique_ptr<diagnostic_updater::Updater> updater_;
  ros::Subscriber diagnostics_;
  ros::SteadyTimer timer_;
};

}  // namespace datmo

PLUGINLIB_EXPORT_CLASS(datmo::StackNodelet, nodelet::Nodelet)
