// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "datmo_fusion/detection/border_filter.h"
#include "datmo_fusion/detection/moving_object_detector.h"
#include "datmo_fusion/ros/convert/messages.h"
#include "datmo_fusion/ros/shared_keys.h"
#include "datmo_fusion/ros/stage/stage.h"
#include "datmo_fusion/ros/stage/stage_runner.h"

namespace datmo {

struct MovingObjectsStageOptions {
  StreamOptions input;
  MovingObjectDetectorOptions detector;
  bool road_borders = false;
  double border_age = 0.5;  ///< s
  BorderFilterOptions border_filter;

  void visit(OptionVisitor& visitor);
  static SharedKeys sharedKeys();
};

/// Result of one labeled scan.
struct MovingObjectsOutput {
  ObjectArrayPtr objects;     ///< in the frame of the scan
  DroppedObjectsPtr dropped;  ///< removed from them; null without road borders
};

/// Runs MovingObjectDetector and BorderFilter on messages, for both the nodelet and the bag runner.
/// Bad input is dropped and reported to the monitor, never thrown. Without recent borders all
/// objects pass.
class MovingObjectsStage : public Stage {
 public:
  using Options = MovingObjectsStageOptions;

  /// `monitor` must outlive the stage. Throws OptionError.
  MovingObjectsStage(const Checked<MovingObjectsStageOptions>& options, StageMonitor& monitor);

  /// Sets the road for the following scans, in their map frame; used with `road_borders`.
  void handleRoadBorders(const RoadBorders& message);

  /// None if the scan was dropped.
  std::optional<MovingObjectsOutput> handleLabeledScan(const LabeledScanMessage& message);

  void connect(StagePorts& ports) override;
  std::vector<LiveOption> live() const override { return liveOptions(options_); }
  void change(const OptionValues& values) override;

 private:
  /// The borders valid for a scan; none, with a warning of the monitor, if there are none.
  std::optional<RoadModel> roadAt(Stamp stamp, const std::string& map_frame);
  DroppedObjectsPtr dropAtBorders(const LabeledScan& scan, const LabeledScanMessage& message,
                                  ObjectList& objects);

  MovingObjectsStageOptions options_;
  StageMonitor& monitor_;
  MovingObjectDetector detector_;
  BorderFilter border_filter_;
  StageRunner runner_;
  std::optional<RoadModel> road_;  ///< the newest
  std::string road_frame_;
};

}  // namespace datmo
