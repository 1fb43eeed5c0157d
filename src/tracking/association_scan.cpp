// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/tracking/association_scan.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "datmo_fusion/tracking/object_check.h"

namespace datmo {

namespace {

/// An object in the fixed frame, and its index in the list.
struct Entry {
  Object object;
  std::size_t listed;
  double distance;  ///< m, from the vehicle
};

auto position(const Entry& entry) {
  const Box2& box = entry.object.box;
  return std::make_tuple(box.center.x(), box.center.y(), box.center.heading(), box.length,
                         box.width, entry.object.log_odds);
}

bool isLeft(const Entry& a, const Entry& b) { return position(a) < position(b); }

bool isNearer(const Entry& a, const Entry& b) {
  return std::tie(a.distance) < std::tie(b.distance) || (a.distance == b.distance && isLeft(a, b));
}

/// Upper bound for the variance of the center from the visible sides, m^2.
double variance(const Object& object) {
  double sum = object.position_covariance.trace();
  for (const double side : object.side_variance) {
    sum += std::isfinite(side) ? side : 0.0;
  }
  return sum;
}

}  // namespace

std::vector<std::size_t> AssociationScan::listedSources(std::size_t observation) const {
  std::vector<std::size_t> result;
  for (const std::size_t source : observations[observation].sources) {
    result.push_back(listed[source]);
  }
  std::sort(result.begin(), result.end());
  return result;
}

std::optional<TransitionModel> AssociationScan::transitionsOf(ObjectClass object_class) const {
  return transition_priors ? transition_priors->modelOf(object_class) : std::nullopt;
}

void ScanIntakeOptions::visit(OptionVisitor& visitor) {
  visitor.number({"new_density", "1/m^2",
                  "density of objects of no target in one scan, new ones and false alarms, where "
                  "none were seen recently: an object must be likelier for its target"},
                 new_density, {1e-9, 10.0});
  visitor.integer({"max_objects", "1",
                   "maximum number of objects taken from one list, the nearest ones; bounds the "
                   "time of a step"},
                  max_objects, {1, 10000});
}

AssociationScan ingest(const std::vector<Object>& objects, const Pose2& base_in_fixed,
                       const Visibility& visibility, const ClutterMap& clutter,
                       const ScanIntakeOptions& options, ScanIntakeCounts& counts) {
  std::vector<Entry> entries;
  entries.reserve(objects.size());
  for (std::size_t i = 0; i < objects.size(); ++i) {
    Object object = transformed(base_in_fixed, objects[i]);
    if (isValid(object)) {
      entries.push_back({std::move(object), i, objects[i].box.center.position().norm()});
    }
  }
  counts.rejected += objects.size() - entries.size();
  const auto max = static_cast<std::size_t>(options.max_objects);
  if (entries.size() > max) {
    std::sort(entries.begin(), entries.end(), isNearer);
    counts.refused += entries.size() - max;
    entries.resize(max);
  }
  counts.accepted += entries.size();
  std::vector<Entry*> from_left;  // pointers, because objects are too large to move
  from_left.reserve(entries.size());
  for (Entry& entry : entries) {
    from_left.push_back(&entry);
  }
  std::sort(from_left.begin(), from_left.end(),
            [](const Entry* a, const Entry* b) { return isLeft(*a, *b); });

  AssociationScan scan;
  scan.observations.reserve(entries.size());
  scan.centers.reserve(entries.size());
  scan.bounds.reserve(entries.size());
  scan.listed.reserve(entries.size());
  scan.objects = entries.size();
  scan.visibility = &visibility;
  scan.fixed_in_base = base_in_fixed.inverse();
  for (Entry* const next : from_left) {
    Entry& entry = *next;
    const Box2& box = entry.object.box;
    scan.noise = std::max(scan.noise, std::sqrt(variance(entry.object)));
    scan.extent = std::max(scan.extent, std::hypot(box.length, box.width));
    const Point2& in_base = objects[entry.listed].box.center.position();
    const double density = options.new_density + clutter.density(in_base);
    const ObservedTarget target = entry.object.dynamic_state == DynamicState::kStatic
                                      ? ObservedTarget::kKnownOrNone
                                      : ObservedTarget::kKnownOrNew;
    scan.centers.push_back(box.center.position());
    scan.bounds.emplace_back(entry.object);
    scan.bound.widen(scan.bounds.back());
    scan.observations.push_back(
        {std::move(entry.object), {scan.listed.size()}, std::log(density), target});
    scan.listed.push_back(entry.listed);
  }
  return scan;
}

}  // namespace datmo
