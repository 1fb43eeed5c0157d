#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/node_handle.h>

#include "datmo_fusion/ros/stage_monitor.h"

namespace datmo {

/// Publishes what a StageMonitor knows: diagnostics once a second, whether messages come or not,
/// and a StageTiming on the topic `timing`, which all stages share, for each result.
///
/// The beat of the diagnostics is the computer's, so that they come when the data's clock stands
/// still too; rates and silences are measured on ROS time, so that a bag played fast or slow shows
/// the sensor's own.
class StageReporter {
 public:
  /// `inputs`: those that are missed if they are silent for `silence_after` (s). `monitor` must
  /// outlive the reporter; both live in the callback queue of `node`.
  StageReporter(ros::NodeHandle node, ros::NodeHandle private_node, const StageMonitor& monitor,
                std::vector<std::string> inputs, double silence_after);

  /// To be called after each result.
  void publishTiming();

 private:
  void diagnose(diagnostic_updater::DiagnosticStatusWrapper& status);
  void diagnoseErrors(diagnostic_updater::DiagnosticStatusWrapper& status);
  void diagnoseInputs(diagnostic_updater::DiagnosticStatusWrapper& status) const;
  void listCounts(diagnostic_updater::DiagnosticStatusWrapper& status) const;

  const StageMonitor& monitor_;
  std::vector<std::string> inputs_;
  double silence_after_;
  std::uint64_t reported_errors_ = 0;
  ros::Publisher timing_;
  diagnostic_updater::Updater updater_;
  ros::SteadyTimer timer_;
};

}  // namespace datmo
