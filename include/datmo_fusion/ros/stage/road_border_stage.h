// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "datmo_fusion/road/road_border_detector.h"
#include "datmo_fusion/ros/convert/messages.h"
#include "datmo_fusion/ros/shared_keys.h"
#include "datmo_fusion/ros/stage/stage.h"
#include "datmo_fusion/ros/stage/stage_runner.h"

namespace datmo {

struct RoadBorderStageOptions {
  StreamOptions input;
  RoadBorderDetectorOptions detector;

  void visit(OptionVisitor& visitor);
  static SharedKeys sharedKeys();
};

/// Runs RoadBorderDetector on messages, for both the nodelet and the bag runner. Bad input is
/// dropped and reported to the monitor, never thrown. The road is forgotten when the clock jumps
/// back or the map frame changes.
class RoadBorderStage : public Stage {
 public:
  using Options = RoadBorderStageOptions;

  /// `monitor` must outlive the stage. Throws OptionError.
  RoadBorderStage(const Checked<RoadBorderStageOptions>& options, StageMonitor& monitor);

  /// Returns the road in the labeled scan's map frame; null if the scan was dropped.
  RoadBordersPtr handleLabeledScan(const LabeledScanMessage& message);

  void connect(StagePorts& ports) override;
  std::vector<LiveOption> live() const override { return liveOptions(options_); }
  void change(const OptionValues& values) override;

 private:
  void show(const RoadModel& road);

  RoadBorderStageOptions options_;
  StageMonitor& monitor_;
  RoadBorderDetector detector_;
  StageRunner runner_;
  std::string map_frame_;  ///< of the last scan; empty before the first
};

}  // namespace datmo
