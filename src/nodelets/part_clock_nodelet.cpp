// SPDX-License-Identifier: BSD-3-Clause
#include <cstdint>

#include <nodelet/nodelet.h>
#include <pluginlib/class_list_macros.hpp>
#include <ros/this_node.h>
#include <std_msgs/Time.h>

#include "datmo_fusion/ros/convert/messages.h"

namespace datmo {

/// Answers what the clock of its machine shows. In: clock_question. Out: clock_answer, in the name
/// of the process that it is in.
class PartClockNodelet : public nodelet::Nodelet {
 private:
  void onInit() override {
    answers_ = getNodeHandle().advertise<PartClock>("clock_answer", kQueue);
    questions_ = getNodeHandle().subscribe("clock_question", kQueue, &PartClockNodelet::answer,
                                           this, ros::TransportHints().tcpNoDelay());
  }

  void answer(const std_msgs::TimeConstPtr& question) {
    PartClock answer;
    answer.process = ros::this_node::getName();
    answer.asked = question->data;
    const ros::WallTime now = ros::WallTime::now();
    answer.answered = ros::Time(now.sec, now.nsec);
    answers_.publish(answer);
  }

  /// An answer to the last question is worth more than those to all before it.
  static constexpr std::uint32_t kQueue = 1;

  ros::Publisher answers_;
  ros::Subscriber questions_;
};

}  // namespace datmo

PLUGINLIB_EXPORT_CLASS(datmo::PartClockNodelet, nodelet::Nodelet)
