// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "live_server.h"

#include <ros/node_handle.h>

#include "datmo_fusion/ros/stage/stage.h"
#include "datmo_fusion/ros/stage/stage_reporter.h"
#include "datmo_fusion/ros/transform_subscription.h"

namespace datmo {

/// Hosts a stage live: creates its subscribers and publishers, forwards its reports to diagnostics
/// and the console, times its results, and offers its live options (LiveServer). Everything runs in
/// the callback queue of `node`, which handles one message at a time.
class StageHost : private StagePorts {
 public:
  /// `transforms` null: the stage does not use tf. `silence_after`: s. All must outlive the host.
  StageHost(ros::NodeHandle node, ros::NodeHandle private_node, Stage& stage, StageMonitor& monitor,
            TransformBuffer* transforms, double silence_after);

 private:
  bool hasSimulatedTime() const override { return ros::Time::isSimTime(); }
  void addInput(StageInput input) override;
  StageOutput::Publish addOutput(StageOutput output) override;
  void addService(StageService service) override;

  void offerLiveOptions();
  void beginReports(double silence_after);
  void subscribe(const StageInput& input);
  void publishReady();
  /// Publishes the timing of results since the last call.
  void publishTiming();

  ros::NodeHandle node_;
  ros::NodeHandle private_node_;
  Stage& stage_;
  StageMonitor& monitor_;
  std::vector<StageInput> inputs_;
  /// Tell the master of outputs and services, which can be used afterward.
  std::vector<std::function<void()>> announcements_;
  std::vector<std::string> outputs_;  ///< topics, as named by the stage
  std::uint64_t timed_ = 0;           ///< results already reported
  std::unique_ptr<StageReporter> reporter_;
  std::unique_ptr<LiveServer> live_;
  std::unique_ptr<TransformSubscription> transforms_;
  std::vector<Subscription> subscriptions_;
  std::vector<std::shared_ptr<ros::ServiceServer>> services_;
  ros::Timer timer_;
};

}  // namespace datmo
