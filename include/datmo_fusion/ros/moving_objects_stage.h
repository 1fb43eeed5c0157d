#pragma once

#include "datmo_fusion/detection/moving_object_detector.h"
#include "datmo_fusion/ros/messages.h"
#include "datmo_fusion/ros/stage_monitor.h"
#include "datmo_fusion/ros/stamp_check.h"

namespace datmo {

struct MovingObjectsStageOptions {
  StreamOptions input;
  MovingObjectDetectorOptions detector;

  void visit(OptionVisitor& visitor);
};

/// MovingObjectDetector between messages: the same one serves the nodelet and the bag runner. Bad
/// input is dropped through the monitor, never thrown.
class MovingObjectsStage {
 public:
  /// `monitor` must outlive the stage. Throws OptionError.
  MovingObjectsStage(const MovingObjectsStageOptions& options, StageMonitor& monitor);

  /// Objects in the frame of the scan; null if the scan was dropped.
  ObjectArrayPtr takeSplitScan(const SplitScanMessage& message);

 private:
  StageMonitor& monitor_;
  MovingObjectDetector detector_;
  StampCheck stamps_;
};

}  // namespace datmo
