// SPDX-License-Identifier: BSD-3-Clause
#include <cstdint>
#include <memory>

#include <nodelet/nodelet.h>
#include <pluginlib/class_list_macros.hpp>
#include <ros/this_node.h>
#include <std_msgs/Time.h>

#include "datmo_fusion/ros/convert/messages.h"
#include "datmo_fusion/ros/stage/stage_monitor.h"
#include "datmo_fusion/ros/subscription.h"

namespace datmo {

/// Answers with the clock reading of its machine. In: clock_question. Out: clock_answer, under the
/// name of its process.
class PartClockNodelet : public nodelet::Nodelet {
 private:
  void onInit() override {
    monitor_ = std::make_unique<StageMonitor>(getName());
    answers_ = getNodeHandle().advertise<PartClock>("clock_answer", kQueue);
    questions_ = Subscription::to(getNodeHandle(), "clock_question", kQueue, *monitor_,
                                  &PartClockNodelet::answer, this);
  }

  void answer(const std_msgs::TimeConstPtr& question) {
    PartClock answer;
    answer.process = ros::this_node::getName();
    answer.asked = question->data;
    const ros::WallTime now = ros::WallTime::now();
    answer.answered = ros::Time(now.sec, now.nsec);
    answers_.publish(answer);
  }

  /// Only the latest question matters.
  static constexpr std::uint32_t kQueue = 1;

  std::unique_ptr<StageMonitor> monitor_;
  ros::Publisher answers_;
  Subscription questions_;
};

}  // namespace datmo

PLUGINLIB_EXPORT_CLASS(datmo::PartClockNodelet, nodelet::Nodelet)
