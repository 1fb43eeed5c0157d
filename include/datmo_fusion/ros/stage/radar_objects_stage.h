// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include <datmo_fusion/RadarScan.h>

#include "datmo_fusion/detection/radar_object_detector.h"
#include "datmo_fusion/ros/frame_options.h"
#include "datmo_fusion/ros/motion_options.h"
#include "datmo_fusion/ros/stage/object_source.h"
#include "datmo_fusion/ros/transform_buffer.h"

namespace datmo {

// Not in messages.h, which all stages include: only this stage uses it.
using RadarScanMessage = datmo_fusion::RadarScan;

struct RadarObjectsStageOptions {
  FrameOptions frames;         ///< shared by all stages
  MotionOptions motion;        ///< shared by all stages
  double min_range = 0.5;      ///< m
  double max_range = 250.0;    ///< m
  double max_doppler = 100.0;  ///< m/s
  int max_returns = 1000;
  StreamOptions input;
  RadarObjectDetectorOptions detector;

  void visit(OptionVisitor& visitor);
};

/// Runs RadarObjectDetector on messages. A cycle with unknown vehicle motion is dropped, since
/// stationary objects would appear to move.
class RadarObjectsStage : public ObjectSource<RadarScanMessage> {
 public:
  using Options = RadarObjectsStageOptions;

  /// `transforms` and `monitor` must outlive the stage. Throws OptionError.
  RadarObjectsStage(const Checked<RadarObjectsStageOptions>& options,
                    const TransformBuffer& transforms, StageMonitor& monitor);

 private:
  ObjectList detect(const RadarScanMessage& message) override;
  /// Drops invalid returns, with a warning.
  RadarCycle cycleOf(const RadarScanMessage& message);
  /// Throws InputError (`no_motion`).
  Twist2 twistAt(Stamp stamp) const;

  RadarObjectsStageOptions options_;
  RadarObjectDetector detector_;
  std::uint64_t bad_returns_ = 0;
};

}  // namespace datmo
