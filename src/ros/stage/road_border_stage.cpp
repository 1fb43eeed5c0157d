// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/stage/road_border_stage.h"

#include <algorithm>

#include <boost/make_shared.hpp>

#include "datmo_fusion/ros/convert/message_conversion.h"
#include "datmo_fusion/ros/convert/road_conversion.h"

namespace datmo {

void RoadBorderStageOptions::visit(OptionVisitor& visitor) {
  visitor.group("input", [&] { input.visit(visitor); });
  detector.visit(visitor);
}

SharedKeys RoadBorderStageOptions::sharedKeys() {
  return SharedKeys().key("tracks/border/range_sigma", "scanner/range_sigma");
}

RoadBorderStage::RoadBorderStage(const Checked<RoadBorderStageOptions>& options,
                                 StageMonitor& monitor)
    : options_(*options),
      monitor_(monitor),
      detector_(options->detector),
      runner_(monitor, options->input, "forgets the road", [this] {
        detector_.reset();
        map_frame_.clear();
      }) {}

RoadBordersPtr RoadBorderStage::handleLabeledScan(const LabeledScanMessage& message) {
  return runner_.serve([&] {
    const LabeledScan scan = fromMessage(message);
    if (message.map_frame.empty()) {
      throw InputError("wrong_frame", "labeled scan without map_frame: expected the map's name");
    }
    runner_.check("labeled_scan", message.header.stamp);
    if (!map_frame_.empty() && message.map_frame != map_frame_) {
      runner_.reset("other_map",
                    "the map is '" + message.map_frame + "', it was '" + map_frame_ + "' before");
    }
    map_frame_ = message.map_frame;
    const RoadModel& road = detector_.update(scan);
    show(road);
    auto borders = boost::make_shared<RoadBorders>(toMessage(road, map_frame_));
    runner_.processed(scan.stamp);
    return borders;
  });
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

void RoadBorderStage::change(const OptionValues& values) {
  const auto changed = withLiveValues(options_, values);
  detector_.setPublished(changed.detector.published);
  options_ = changed;
}

void RoadBorderStage::connect(StagePorts& ports) {
  const auto borders = ports.out<RoadBorders>("road_borders");
  ports.in<LabeledScanMessage>("labeled_scan", [this, borders](const auto& scan, Stamp /*now*/) {
    borders.publish(handleLabeledScan(*scan));
  });
}

}  // namespace datmo
