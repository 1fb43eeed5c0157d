// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/node_handle.h>

#include "datmo_fusion/ros/stage/input_progress.h"
#include "datmo_fusion/ros/stage/stage_monitor.h"

namespace datmo {

/// Publishes what a StageMonitor knows: diagnostics once a second, whether messages come or not,
/// and a StageTiming on the topic `timing`, which all stages share, for each result. Says on the
/// console what comes for the first time and what does not come.
///
/// The beat of the diagnostics is the computer's, so that they come when the data's clock stands
/// still too; rates and silences are measured on ROS time, so that a bag played fast or slow shows
/// the sensor's own.
class StageReporter {
 public:
  /// `inputs`: those that are missed if they are silent for `silence_after` (s). `monitor` must
  /// outlive the reporter; both live in the callback queue of `node`.
  StageReporter(ros::NodeHandle node, ros::NodeHandle private_node, StageMonitor& monitor,
                std::vector<std::string> inputs, double silence_after);

  /// `input` may come on `topic` (resolved) instead of the one of its own name.
  void alsoOn(const std::string& input, const std::string& topic);

  /// To be called after each result.
  void publishTiming();

 private:
  void sayNews();
  void diagnose(diagnostic_updater::DiagnosticStatusWrapper& status);
  void diagnoseErrors(diagnostic_updater::DiagnosticStatusWrapper& status);
  void diagnoseInputs(diagnostic_updater::DiagnosticStatusWrapper& status) const;
  void listCounts(diagnostic_updater::DiagnosticStatusWrapper& status) const;

  StageMonitor& monitor_;
  std::vector<std::string> inputs_;
  double silence_after_;
  InputProgress progress_;
  Stopwatch since_start_;
  std::uint64_t reported_errors_ = 0;
  std::optional<double> last_latency_;  ///< s; none before the first result
  ros::Publisher timing_;
  diagnostic_updater::Updater updater_;
  ros::SteadyTimer timer_;
};

}  // namespace datmo
