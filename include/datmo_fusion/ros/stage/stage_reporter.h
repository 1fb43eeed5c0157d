// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <diagnostic_msgs/DiagnosticStatus.h>
#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/node_handle.h>

#include "datmo_fusion/ros/stage/input_progress.h"
#include "datmo_fusion/ros/stage/published_topics.h"
#include "datmo_fusion/ros/stage/stage_monitor.h"

namespace datmo {

/// Returns the level of a status: ERROR for no output, WARN for reduced output.
unsigned char diagnosticLevel(HealthLevel level);

/// Returns the state in a stage's status, for programs that monitor all stages; none for another
/// kind of status.
std::optional<StageState> stateOf(const diagnostic_msgs::DiagnosticStatus& status);

/// Publishes the content of a StageMonitor: diagnostics once a second, with or without messages,
/// and for each result a StageTiming on the topic `timing`, which all stages share. Prints on the
/// console what is received for the first time and what is missing.
///
/// Diagnostics are timed by the wall clock, so that they are published even when the data's clock
/// stands still; rates and silences are measured in ROS time, so that a bag played at any rate
/// shows the sensors' own.
class StageReporter {
 public:
  /// `inputs`: those reported missing after a silence of `silence_after` (s). `topics`: all inputs
  /// and outputs, resolved. `monitor` must outlive the reporter; both must be used in the callback
  /// queue of `node`.
  StageReporter(ros::NodeHandle node, ros::NodeHandle private_node, StageMonitor& monitor,
                std::vector<WatchedInput> inputs, StageTopics topics, double silence_after);

  /// To be called after each result.
  void publishTiming();

  StageReporter(const StageReporter&) = delete;
  StageReporter& operator=(const StageReporter&) = delete;

 private:
  /// Queries the master when the first type is needed.
  PublishedType askMaster();
  void logChanges();
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
  PublishedTopics published_;
  ros::Publisher timing_;
  diagnostic_updater::Updater updater_;
  ros::SteadyTimer timer_;
};

}  // namespace datmo
