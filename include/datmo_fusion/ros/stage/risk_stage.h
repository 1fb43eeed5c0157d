// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <geometry_msgs/AccelWithCovarianceStamped.h>
#include <nav_msgs/Odometry.h>
#include <sensor_msgs/JointState.h>

#include "datmo_fusion/risk/risk_assessor.h"
#include "datmo_fusion/ros/convert/messages.h"
#include "datmo_fusion/ros/convert/risk_conversion.h"
#include "datmo_fusion/ros/frame_options.h"
#include "datmo_fusion/ros/motion_options.h"
#include "datmo_fusion/ros/shared_keys.h"
#include "datmo_fusion/ros/stage/host_input.h"
#include "datmo_fusion/ros/stage/stage.h"
#include "datmo_fusion/ros/stage/stage_runner.h"

namespace datmo {

struct RiskStageOptions {
  FrameOptions frames;   ///< shared by all stages
  MotionOptions motion;  ///< shared by all stages
  StreamOptions input;
  bool road_borders = false;
  double border_age = 0.5;  ///< s
  HostInputOptions host_state;
  RiskOptions risk;

  void visit(OptionVisitor& visitor);
  static SharedKeys sharedKeys();
};

/// Runs RiskAssessor on messages, for both the nodelet and the bag runner. Each list of tracks
/// yields one list of risks at its stamp, with the newest labeled scan, odometry and borders.
/// Steering and acceleration of the host may be measured as well (HostInput).
///
/// Without odometry the host's motion is from its poses, which is reported. Tracks that are
/// invalid, unseen for too long or too many are dropped and reported. The state is reset when the
/// clock jumps.
class RiskStage : public Stage {
 public:
  using Options = RiskStageOptions;

  /// `monitor` must outlive the stage. Throws OptionError.
  RiskStage(const Checked<RiskStageOptions>& options, StageMonitor& monitor);

  void handleLabeledScan(const LabeledScanMessage& message);
  void handleOdometry(const nav_msgs::Odometry& message);
  void handleSteering(const sensor_msgs::JointState& message);
  void handleAcceleration(const geometry_msgs::AccelWithCovarianceStamped& message);
  void handleRoadBorders(const RoadBorders& message);

  /// Null if the message was dropped.
  RiskArrayPtr handleTracks(const TrackArray& message);

  void connect(StagePorts& ports) override;

 private:
  std::optional<RoadModel> roadAt(Stamp stamp);
  void report(const RiskReport& report);
  void reset();

  RiskStageOptions options_;
  StageMonitor& monitor_;
  RiskAssessor assessor_;
  StageRunner runner_;
  HostInput host_;
  std::string map_frame_;         ///< of the newest labeled scan
  std::vector<Point2> standing_;  ///< m, map frame, of the newest labeled scan
  std::optional<RoadModel> road_;
  std::string road_frame_;
};

}  // namespace datmo
