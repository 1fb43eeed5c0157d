// SPDX-License-Identifier: BSD-3-Clause
#include "simulator/ground_truth.h"

#include <algorithm>
#include <cmath>

namespace datmo::simulator {

namespace {

/// Rays over an object's width: its hidden share is known to a few hundredths.
constexpr int kRays = 25;

/// Bearings of the object's right and left edge relative to `bearing` of its center, rad.
struct Extent {
  double middle = 0.0;
  double right = 0.0;
  double left = 0.0;
};

Extent extentOf(const ObjectState& object, const Point2& from) {
  const Point2 to_middle = object.center.position() - from;
  Extent extent;
  extent.middle = std::atan2(to_middle.y(), to_middle.x());
  if (object.kind.round) {
    extent.left = std::asin(std::min(1.0, 0.5 * object.kind.width / to_middle.norm()));
    extent.right = -extent.left;
    return extent;
  }
  for (const Point2& corner : object.box().corners()) {
    const Point2 to_corner = corner - from;
    const double offset = angleBetween(extent.middle, std::atan2(to_corner.y(), to_corner.x()));
    extent.left = std::max(extent.left, offset);
    extent.right = std::min(extent.right, offset);
  }
  return extent;
}

int beamsOn(const ObjectState& object, const EchoScan& scan) {
  return static_cast<int>(std::count_if(
      scan.beams.begin(), scan.beams.end(), [&object](const std::vector<Echo>& echoes) {
        return !echoes.empty() && echoes.front().object == object.id;
      }));
}

}  // namespace

void GroundTruthOptions::visit(OptionVisitor& visitor) {
  visitor.number(
      {"radius", "m", "objects within this distance of the vehicle are in the ground truth"},
      radius, {0.0, 1000.0});
  visitor.number(
      {"min_visible_share", "1",
       "share of an object's width that a sensor must see for the object to count as visible"},
      min_visible_share, {0.0, 1.0});
  visitor.toggle({"echoes", "", "records what each beam's nearest echo came from"}, echoes);
}

LineOfSight lookAt(const ObjectState& object, const Viewpoint& view, const World& world,
                   const WorldState& state) {
  const Pose2 sensor = state.base * view.sensor_in_base;
  const double distance = (object.center.position() - sensor.position()).norm();
  const double reach = distance + 0.5 * (object.kind.length + object.kind.width);
  const RayCaster caster(world, state, sensor.position(), reach);
  const HeightBand level{view.height, 0.0, 0.0};
  const Extent extent = extentOf(object, sensor.position());
  int hidden = 0;
  int visible = 0;
  for (int i = 0; i < kRays; ++i) {
    const double share = (i + 0.5) / kRays;
    const double heading = extent.middle + extent.right + share * (extent.left - extent.right);
    const auto hit = caster.nearest(heading, level, Surface::kBody, reach);
    const bool in_field =
        std::abs(angleBetween(sensor.heading(), heading)) <= 0.5 * view.field_of_view;
    if (hit && hit->object != object.id) {
      ++hidden;
    } else if (hit && in_field && hit->range <= view.range) {
      ++visible;
    }
  }
  return {static_cast<double>(hidden) / kRays, static_cast<double>(visible) / kRays};
}

std::vector<ObjectTruth> objectTruths(const World& world, const WorldState& state,
                                      const EchoScan& scan, const std::vector<Viewpoint>& views,
                                      const GroundTruthOptions& options) {
  std::vector<ObjectTruth> truths;
  for (const ObjectState& object : state.objects) {
    if ((object.center.position() - state.base.position()).norm() > options.radius) {
      continue;
    }
    ObjectTruth truth;
    truth.state = object;
    truth.lidar_beams = beamsOn(object, scan);
    truth.occlusion = lookAt(object, views.front(), world, state).hidden;
    for (const Viewpoint& view : views) {
      const double visible = lookAt(object, view, world, state).visible;
      if (visible > 0.0 && visible >= options.min_visible_share) {
        truth.visible_to.push_back(view.sensor);
      }
    }
    truths.push_back(truth);
  }
  return truths;
}

}  // namespace datmo::simulator
