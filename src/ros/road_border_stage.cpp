#include "datmo_fusion/ros/road_border_stage.h"

#include <algorithm>

#include <boost/make_shared.hpp>

#include "datmo_fusion/ros/message_conversion.h"
#include "datmo_fusion/ros/road_conversion.h"

namespace datmo {

void RoadBorderStageOptions::visit(OptionVisitor& visitor) {
  visitor.group("input", [&] { input.visit(visitor); });
  detector.visit(visitor);
}

RoadBorderStage::RoadBorderStage(const RoadBorderStageOptions& options, StageMonitor& monitor)
    : monitor_(monitor), detector_(options.detector), stamps_(options.input.restart_after) {
  checkOptions(options);
}

RoadBordersPtr RoadBorderStage::takeLabeledScan(const LabeledScanMessage& message) {
  try {
    const Stopwatch watch;
    const LabeledScan scan = fromMessage(message);
    if (message.map_frame.empty()) {
      throw InputError("wrong_frame", "split scan without map_frame: expected the map's name");
    }
    if (stamps_.check(message.header.stamp) == Arrival::kRestart) {
      restart("clock_restart", "the clock jumped back");
    } else if (!map_frame_.empty() && message.map_frame != map_frame_) {
      restart("other_map",
              "the map is '" + message.map_frame + "', it was '" + map_frame_ + "' before");
    }
    map_frame_ = message.map_frame;
    const RoadModel& road = detector_.update(scan);
    show(road);
    auto borders = boost::make_shared<RoadBorders>(toMessage(road, map_frame_));
    monitor_.processed({scan.stamp, watch.seconds()});
    return borders;
  } catch (const InputError& error) {
    monitor_.dropped(error);
    return nullptr;
  }
}

void RoadBorderStage::restart(const std::string& reason, const std::string& why) {
  monitor_.warned(InputError(reason, why + ": forgets the road"));
  detector_.reset();
}

void RoadBorderStage::show(const RoadModel& road) {
  const auto count = [&](RoadSide side) {
    return static_cast<double>(
        std::count_if(road.borders.begin(), road.borders.end(),
                      [side](const RoadBorder& border) { return border.side == side; }));
  };
  monitor_.figure("stretches of border on the left", count(RoadSide::kLeft));
  monitor_.figure("stretches of border on the right", count(RoadSide::kRight));
  monitor_.figure("at an intersection, 0 to 1", road.intersection_probability);
}

void RoadBorderStage::connect(StagePorts& ports) {
  const auto borders = ports.out<RoadBorders>("road_borders");
  ports.in<LabeledScanMessage>("labeled_scan", [this, borders](const auto& scan, Stamp /*now*/) {
    borders.publish(takeLabeledScan(*scan));
  });
}

}  // namespace datmo
