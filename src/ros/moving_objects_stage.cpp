#include "datmo_fusion/ros/moving_objects_stage.h"

#include <boost/make_shared.hpp>

#include "datmo_fusion/ros/message_conversion.h"

namespace datmo {

void MovingObjectsStageOptions::visit(OptionVisitor& visitor) {
  visitor.group("input", [&] { input.visit(visitor); });
  detector.visit(visitor);
}

MovingObjectsStage::MovingObjectsStage(const MovingObjectsStageOptions& options,
                                       StageMonitor& monitor)
    : monitor_(monitor), detector_(options.detector), stamps_(options.input.restart_after) {
  checkOptions(options);
}

ObjectArrayPtr MovingObjectsStage::takeSplitScan(const SplitScanMessage& message) {
  try {
    const Stopwatch watch;
    const SplitScan scan = fromMessage(message);
    // Without memory from scan to scan, a restart of the clock needs nothing.
    stamps_.check(message.header.stamp);
    auto objects =
        boost::make_shared<ObjectArray>(toMessage(detector_.detect(scan), message.header.frame_id));
    monitor_.processed({scan.stamp, watch.seconds()});
    return objects;
  } catch (const InputError& error) {
    monitor_.dropped(error);
    return nullptr;
  }
}

}  // namespace datmo
