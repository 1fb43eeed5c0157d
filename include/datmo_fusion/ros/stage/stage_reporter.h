// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <diagnostic_msgs/DiagnosticStatus.h>
#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/node_handle.h>

#include "datmo_fusion/ros/stage/input_progress.h"
#include "datmo_fusion/ros/stage/stage_monitor.h"

namespace datmo {

/// Level of a status: ERROR where nothing comes, WARN where less comes.
unsigned char diagnosticLevel(HealthLevel level);

/// What the status of a stage says of it, for whoever looks at all of them; none of another status.
std::optional<StageState> stateOf(const diagnostic_msgs::DiagnosticStatus& status);

/// Publishes what a StageMonitor knows: diagnostics once a second, whether messages come or not,
/// and a StageTiming on the topic `timing`, which all stages share, for each result. Says on the
/// console what comes for the first time and what does not come.
///
/// The beat of the diagnostics is the computer's, so that they come when the data's clock stands
/// still too; rates and silences are measured on ROS time, so that a bag played fast or slow shows
/// the sensor's own.
class StageReporter {
 public:
  /// `inputs`: those that are missed if they are silent for `silence_after` (s). `topics`: of all
  /// inputs and outputs, resolved. `monitor` must outlive the reporter; both live in the callback
  /// queue of `node`.
  StageReporter(ros::NodeHandle node, ros::NodeHandle private_node, StageMonitor& monitor,
                std::vector<WatchedInput> inputs, StageTopics topics, double silence_after);

  /// To be called after each result.
  void publishTiming();

 private:
  void sayNews();
  void diagnose(diagnostic_updater::DiagnosticStatusWrapper& status);
  void listInputs(diagnostic_updater::DiagnosticStatusWrapper& status) const;
  void listCounts(diagnostic_updater::DiagnosticStatusWrapper& status) const;

  StageMonitor& monitor_;
  std::vector<WatchedInput> inputs_;
  StageTopics topics_;
  StageHealth health_;
  InputProgress progress_;
  Stopwatch since_start_;
  std::optional<double> last_latency_;  ///< s; none before the first result
  ros::Publisher timing_;
  diagnostic_updater::Updater updater_;
  ros::SteadyTimer timer_;
};

}  // namespace datmo
