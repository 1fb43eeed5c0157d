// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/stage/moving_objects_stage.h"

#include <cmath>

#include <boost/make_shared.hpp>

#include "datmo_fusion/ros/convert/message_conversion.h"
#include "datmo_fusion/ros/convert/road_conversion.h"

namespace datmo {

void MovingObjectsStageOptions::visit(OptionVisitor& visitor) {
  visitor.group("input", [&] { input.visit(visitor); });
  detector.visit(visitor);
  visitor.toggle({"road_borders", "",
                  "objects on the borders of the road and beyond are less likely to move (thesis "
                  "3.5.1); set by the launch file's switch"},
                 road_borders);
  visitor.number({"border_age", "s", "borders older than this are not used, and all objects pass"},
                 border_age, {0.0, 60.0});
  visitor.group("border_filter", [&] { border_filter.visit(visitor); });
}

SharedKeys MovingObjectsStageOptions::sharedKeys() {
  return SharedKeys().key("range_sigma", "scanner/range_sigma");
}

MovingObjectsStage::MovingObjectsStage(const Checked<MovingObjectsStageOptions>& options,
                                       StageMonitor& monitor)
    : options_(*options),
      monitor_(monitor),
      detector_(options->detector),
      border_filter_(options->border_filter),
      runner_(monitor, options->input, "forgets the road",
              [this] { border_filter_.forgetRoad(); }) {}

void MovingObjectsStage::handleRoadBorders(const RoadBorders& message) {
  if (!options_.road_borders) {
    return;
  }
  runner_.serve([&] {
    road_ = fromMessage(message);
    road_frame_ = message.header.frame_id;
  });
}

std::optional<MovingObjectsOutput> MovingObjectsStage::handleLabeledScan(
    const LabeledScanMessage& message) {
  return runner_.serve([&] {
    const LabeledScan scan = fromMessage(message);
    runner_.check("labeled_scan", message.header.stamp);
    ObjectList objects = detector_.detect(scan);
    MovingObjectsOutput output;
    if (options_.road_borders) {
      output.dropped = dropAtBorders(scan, message, objects);
    }
    output.objects = boost::make_shared<ObjectArray>(toMessage(objects, message.header.frame_id));
    runner_.processed(scan.stamp);
    return std::make_optional(output);
  });
}

std::optional<RoadModel> MovingObjectsStage::roadAt(Stamp stamp, const std::string& map_frame) {
  if (!road_) {
    monitor_.warned({"no_borders", "no borders of the road received yet: all objects pass"});
    return std::nullopt;
  }
  if (road_frame_ != map_frame) {
    monitor_.warned({"wrong_frame", "borders of the road in '" + road_frame_ + "': expected '" +
                                        map_frame + "', the scan's map; all objects pass"});
    return std::nullopt;
  }
  // After a jump of the clock they may also be too new.
  const double age = std::abs(secondsBetween(road_->stamp, stamp));
  if (age > options_.border_age) {
    monitor_.warned({"old_borders", "borders of the road " + std::to_string(age) +
                                        " s from the scan: expected at most " +
                                        std::to_string(options_.border_age) +
                                        " s; all objects pass"});
    return std::nullopt;
  }
  return road_;
}

DroppedObjectsPtr MovingObjectsStage::dropAtBorders(const LabeledScan& scan,
                                                    const LabeledScanMessage& message,
                                                    ObjectList& objects) {
  const std::optional<RoadModel> road = roadAt(scan.stamp, message.map_frame);
  if (!road) {
    border_filter_.forgetRoad();
  }
  const std::vector<DroppedObject> dropped =
      border_filter_.filter(scan.base_in_map.pose, road.value_or(RoadModel{}), objects);
  monitor_.figure("objects dropped at road borders [1]", static_cast<double>(dropped.size()));
  return boost::make_shared<DroppedObjects>(
      toMessage(dropped, scan.stamp, message.header.frame_id));
}

void MovingObjectsStage::change(const OptionValues& values) {
  const auto changed = withLiveValues(options_, values);
  detector_ = MovingObjectDetector(changed.detector);
  options_ = changed;
}

void MovingObjectsStage::connect(StagePorts& ports) {
  const auto objects = ports.out<ObjectArray>("objects");
  StagePublisher<DroppedObjects> dropped;
  if (options_.road_borders) {
    dropped = ports.out<DroppedObjects>("objects/dropped");
    ports.in<RoadBorders>("road_borders", [this](const auto& borders, Stamp /*now*/) {
      handleRoadBorders(*borders);
    });
  }
  ports.in<LabeledScanMessage>("labeled_scan",
                               [this, objects, dropped](const auto& scan, Stamp /*now*/) {
                                 if (const auto found = handleLabeledScan(*scan)) {
                                   objects.publish(found->objects);
                                   dropped.publish(found->dropped);
                                 }
                               });
}

}  // namespace datmo
