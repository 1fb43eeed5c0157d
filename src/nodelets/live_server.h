// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <dynamic_reconfigure/Reconfigure.h>

#include <ros/node_handle.h>

#include "datmo_fusion/common/live_options.h"
#include "datmo_fusion/ros/stage/stage_monitor.h"

namespace datmo {

/// Offers the live options of a nodelet to clients of dynamic_reconfigure (rqt_reconfigure,
/// dynparam). It implements their protocol directly from the declared options: there is no cfg file
/// to keep in sync. Parameters are named by their full keys.
class LiveServer {
 public:
  /// Returns the current live options, and changes some of them; the change throws OptionError if
  /// it is rejected.
  using Present = std::function<std::vector<LiveOption>()>;
  using Change = std::function<void(const OptionValues&)>;

  /// `node`: the nodelet's private one; the functions are called in its callback queue. `monitor`
  /// must outlive it.
  LiveServer(ros::NodeHandle node, StageMonitor& monitor, Present present, Change change);

 private:
  /// Errors are printed on the console, and counted if they are no OptionError (guarded()); the
  /// response has the values in effect. Returns false, as which the call fails, without them.
  bool setParameters(dynamic_reconfigure::Reconfigure::Request& request,
                     dynamic_reconfigure::Reconfigure::Response& response);

  /// Publishes to clients and the parameter server.
  void publish(const std::vector<LiveOption>& options);

  ros::NodeHandle node_;
  StageMonitor& monitor_;
  Present present_;
  Change change_;
  ros::Publisher descriptions_;
  ros::Publisher updates_;
  ros::ServiceServer service_;
};

}  // namespace datmo
