// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/tracking/late_classes.h"

#include <algorithm>
#include <map>
#include <utility>

#include "datmo_fusion/common/waiting_bound.h"
#include "datmo_fusion/tracking/kalman_filter.h"
#include "datmo_fusion/tracking/object_check.h"

namespace datmo {

void LateClasses::add(ObjectList classes) {
  const auto valid = std::remove_if(classes.objects.begin(), classes.objects.end(),
                                    [](const Object& object) { return !isValid(object); });
  counts_.rejected += static_cast<std::uint64_t>(classes.objects.end() - valid);
  classes.objects.erase(valid, classes.objects.end());
  waiting_.push_back(std::move(classes));
  if (waiting_.size() > kMaxWaitingSamples) {
    counts_.without_target += waiting_.front().objects.size();
    waiting_.pop_front();
  }
}

void LateClasses::note(Stamp stamp, const std::vector<BestTarget>& targets,
                       const AssociationScan& scan) {
  KnownScan known;
  while (scans_.size() >= kMaxWaitingSamples ||
         (!scans_.empty() && secondsBetween(scans_.front().stamp, stamp) > kMaxAge)) {
    known = std::move(scans_.front());  // whose memory is reused
    scans_.pop_front();
  }
  known.stamp = stamp;
  known.base_in_fixed = scan.fixed_in_base.inverse();
  known.objects.clear();
  for (std::size_t i = 0; i < scan.objects; ++i) {
    const Object& object = scan.observations[i].object;
    known.objects.push_back({object.box.center.position(), object.position_covariance, 0});
  }
  for (const BestTarget& best : targets) {
    if (best.target->measurementIndex() != kUnseen) {
      for (const std::size_t source : scan.observations[best.target->measurementIndex()].sources) {
        known.objects[source].target = best.target->number();
      }
    }
  }
  scans_.push_back(std::move(known));
}

std::vector<TargetClass> LateClasses::take() {
  std::vector<TargetClass> matched;
  if (scans_.empty()) {
    return matched;
  }
  for (auto classes = waiting_.begin(); classes != waiting_.end();) {
    if (classes->stamp > scans_.back().stamp) {
      ++classes;
      continue;
    }
    const auto scan = std::find_if(scans_.begin(), scans_.end(), [&](const KnownScan& one) {
      return one.stamp == classes->stamp;
    });
    if (scan != scans_.end()) {
      match(*classes, *scan, matched);
    } else {
      counts_.without_target += classes->objects.size();
    }
    classes = waiting_.erase(classes);
  }
  return matched;
}

void LateClasses::match(const ObjectList& classes, const KnownScan& scan,
                        std::vector<TargetClass>& matched) {
  struct Nearest {
    double squared_distance;
    const Object* object;
  };
  std::map<std::uint64_t, Nearest> of_targets;
  for (const Object& reported : classes.objects) {
    const Object object = transformed(scan.base_in_fixed, reported);
    double smallest = gate_;
    const KnownObject* nearest = nullptr;
    for (const KnownObject& known : scan.objects) {
      const double distance = Innovation{object.box.center.position() - known.position,
                                         object.position_covariance + known.covariance}
                                  .squaredDistance();
      if (distance < smallest) {
        smallest = distance;
        nearest = &known;
      }
    }
    // Not that of a neighbor: the class is that of the nearest object, whether it has a target or
    // not.
    if (nearest == nullptr || nearest->target == 0) {
      ++counts_.without_target;
      continue;
    }
    const auto [entry, is_first] =
        of_targets.try_emplace(nearest->target, Nearest{smallest, &reported});
    if (!is_first && smallest < entry->second.squared_distance) {
      entry->second = {smallest, &reported};
    }
  }
  for (const auto& [number, nearest] : of_targets) {
    matched.push_back({number, nearest.object->class_probabilities});
  }
}

void LateClasses::clear() {
  scans_.clear();
  waiting_.clear();
  counts_ = LateClassCounts();
}

}  // namespace datmo
