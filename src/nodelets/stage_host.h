// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "live_server.h"

#include <ros/node_handle.h>

#include "datmo_fusion/ros/stage/stage.h"
#include "datmo_fusion/ros/stage/stage_reporter.h"
#include "datmo_fusion/ros/transform_subscription.h"

namespace datmo {

/// Hosts a stage live: what it declares becomes subscribers and publishers, what it says goes to
/// diagnostics and the console, what it makes is timed, and its live options may be changed
/// (LiveServer). All of it lives in the callback queue
/// of `node`, which serves one message after the other.
class StageHost : private StagePorts {
 public:
  /// `transforms` null: the stage does not ask tf. `silence_after`: s. All must outlive the host.
  StageHost(ros::NodeHandle node, ros::NodeHandle private_node, Stage& stage, StageMonitor& monitor,
            TransformBuffer* transforms, double silence_after);

 private:
  void addInput(StageInput input) override;
  StageOutput::Publish addOutput(StageOutput output) override;
  void addService(StageService service) override;

  void subscribe(const StageInput& input);
  void publishReady();
  /// What was made since the last call goes to the topic of times.
  void publishTiming();

  ros::NodeHandle node_;
  ros::NodeHandle private_node_;
  Stage& stage_;
  StageMonitor& monitor_;
  std::vector<StageInput> inputs_;
  std::vector<std::string> outputs_;  ///< topics, as the stage calls them
  std::uint64_t timed_ = 0;           ///< results
  std::unique_ptr<StageReporter> reporter_;
  std::unique_ptr<LiveServer> live_;
  std::unique_ptr<TransformSubscription> transforms_;
  std::vector<ros::Subscriber> subscribers_;
  std::vector<ros::ServiceServer> services_;
  ros::Timer timer_;
};

}  // namespace datmo
