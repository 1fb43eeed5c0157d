// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <dynamic_reconfigure/Reconfigure.h>

#include <ros/node_handle.h>

#include "datmo_fusion/common/live_options.h"

namespace datmo {

/// The live options of a nodelet for clients of dynamic_reconfigure (rqt_reconfigure, dynparam).
/// It speaks their protocol from the declared options themselves: there is no cfg file to hold
/// against them. Parameters are called by their full keys.
class LiveServer {
 public:
  /// The live options now, and the change of some: that throws OptionError if it is refused.
  using Present = std::function<std::vector<LiveOption>()>;
  using Change = std::function<void(const OptionValues&)>;

  /// `node`: the nodelet's private one; the functions are called in its callback queue.
  LiveServer(ros::NodeHandle node, Present present, Change change);

 private:
  /// What is refused is said on the console; the response has what holds.
  bool take(dynamic_reconfigure::Reconfigure::Request& request,
            dynamic_reconfigure::Reconfigure::Response& response);

  /// To clients and the parameter server.
  void publish(const std::vector<LiveOption>& options);

  ros::NodeHandle node_;
  Present present_;
  Change change_;
  ros::Publisher descriptions_;
  ros::Publisher updates_;
  ros::ServiceServer service_;
};

}  // namespace datmo
