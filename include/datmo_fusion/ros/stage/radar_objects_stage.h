// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include <datmo_fusion/RadarScan.h>

#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <nav_msgs/Odometry.h>

#include "datmo_fusion/detection/radar_object_detector.h"
#include "datmo_fusion/ros/convert/messages.h"
#include "datmo_fusion/ros/frame_options.h"
#include "datmo_fusion/ros/stage/motion_input.h"
#include "datmo_fusion/ros/stage/stage.h"
#include "datmo_fusion/ros/stage/stage_runner.h"
#include "datmo_fusion/ros/transform_buffer.h"

namespace datmo {

// As in messages.h, which all stages include; this is of one alone.
using RadarScanMessage = datmo_fusion::RadarScan;

struct RadarObjectsStageOptions {
  FrameOptions frames;         ///< of all stages
  MotionOptions motion;        ///< of all stages
  double min_range = 0.5;      ///< m
  double max_range = 250.0;    ///< m
  double max_doppler = 100.0;  ///< m/s
  int max_returns = 1000;
  StreamOptions input;
  RadarObjectDetectorOptions detector;

  void visit(OptionVisitor& visitor);
};

/// RadarObjectDetector between messages: one more source of objects. Bad input is dropped or warned
/// of through the monitor, never thrown. A cycle at which the vehicle's motion is not known is
/// dropped: what stands would drive.
class RadarObjectsStage : public Stage {
 public:
  using Options = RadarObjectsStageOptions;

  /// `transforms` and `monitor` must outlive the stage. Throws OptionError.
  RadarObjectsStage(const Checked<RadarObjectsStageOptions>& options,
                    const TransformBuffer& transforms, StageMonitor& monitor);

  void takeOdometry(const nav_msgs::Odometry& message) { takeMotion(message); }
  void takePose(const geometry_msgs::PoseWithCovarianceStamped& message) { takeMotion(message); }

  /// Objects in the vehicle's frame at the cycle's stamp; null if the cycle was dropped.
  ObjectArrayPtr takeScan(const RadarScanMessage& message);

  void connect(StagePorts& ports) override;

 private:
  template <typename Message>
  void takeMotion(const Message& message) {
    runner_.serve([&] { motion_.take(message); });
  }

  /// Without the returns that are none, which are warned of.
  RadarCycle cycleOf(const RadarScanMessage& message);
  /// Throws InputError (`no_motion`).
  Twist2 twistAt(Stamp stamp) const;

  RadarObjectsStageOptions options_;
  const TransformBuffer& transforms_;
  StageMonitor& monitor_;
  RadarObjectDetector detector_;
  StageRunner runner_;
  MotionInput motion_;
  std::uint64_t bad_returns_ = 0;
};

}  // namespace datmo
