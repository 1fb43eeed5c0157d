// SPDX-License-Identifier: BSD-3-Clause
#include "object_intake.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <tuple>
#include <utility>

#include "datmo_fusion/tracking/object_check.h"
#include "datmo_fusion/visibility/joint_visibility.h"

namespace datmo {

namespace {

auto position(const Object& object) {
  const Box2& box = object.box;
  return std::make_tuple(box.center.x(), box.center.y(), box.center.heading(), box.length,
                         box.width, object.height, object.log_odds);
}

/// The valid objects, the nearest if there are too many, in a canonical order.
std::vector<const Object*> accepted(const ObjectList& list, std::size_t max,
                                    ObjectFusionCounts& counts) {
  std::vector<const Object*> objects;
  for (const Object& object : list.objects) {
    if (isValid(object)) {
      objects.push_back(&object);
    }
  }
  counts.rejected += list.objects.size() - objects.size();
  if (objects.size() > max) {
    std::sort(objects.begin(), objects.end(), [](const Object* a, const Object* b) {
      const double to_a = a->box.center.position().norm();
      const double to_b = b->box.center.position().norm();
      return to_a < to_b || (to_a == to_b && position(*a) < position(*b));
    });
    counts.refused += objects.size() - max;
    objects.resize(max);
  }
  std::sort(objects.begin(), objects.end(),
            [](const Object* a, const Object* b) { return position(*a) < position(*b); });
  return objects;
}

Point2 sensorOf(const ObjectList& list) {
  return list.views.empty() ? Point2::Zero() : list.views.front().field.sensor_in_base.position();
}

/// Evidence of the scan on another source's object; may set the object to static.
PositionEvidence evidenceOf(Object& object, const ScanSupport& scan_support,
                            const ObjectFuserOptions& options) {
  const double moved = options.association.object_speed * std::abs(object.delay);
  const PositionEvidence evidence = scan_support.evidence(object, moved);
  if (scan_support.standsStill(evidence)) {
    treatAsStanding(object);
  }
  return evidence;
}

}  // namespace

ObjectIntake ingest(const SourceObjects& source, Stamp reference, const ScanSupport* scan_support,
                    const ObjectFuserOptions& options, ObjectFusionCounts& counts) {
  const PositionCovarianceOptions& covariance = options.sources.at(source.source).covariance;
  const bool has_scan_evidence = scan_support != nullptr && source.source != options.scanner;
  const double later = secondsBetween(reference, source.list.stamp);
  const Point2 sensor = sensorOf(source.list);
  ObjectIntake intake;
  for (const Object* listed :
       accepted(source.list, static_cast<std::size_t>(options.max_objects), counts)) {
    Object own = *listed;
    if (!covariance.empty()) {
      own.position_covariance = covariance.at(own.box.center.position(), sensor);
    }
    Object object = transformed(source.base_in_reference, own);
    object.delay += later;
    intake.scan_evidence.push_back(has_scan_evidence ? evidenceOf(object, *scan_support, options)
                                                     : PositionEvidence());
    intake.list.objects.push_back(std::move(object));
  }
  intake.sensor = source.base_in_reference * sensor;
  intake.list.stamp = reference;
  intake.list.views = source.list.views;
  for (SensorView& view : intake.list.views) {
    view.field.sensor_in_base = source.base_in_reference * view.field.sensor_in_base;
  }
  if (!intake.list.views.empty()) {
    intake.visibility = jointVisibility(nullptr, intake.list, options.visibility);
  }
  return intake;
}

void treatAsStanding(Object& object) {
  if (object.dynamic_state == DynamicState::kUnknown) {
    object.dynamic_state = DynamicState::kStatic;
  }
}

}  // namespace datmo
