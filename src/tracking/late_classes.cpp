// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/tracking/late_classes.h"

#include <algorithm>
#include <map>
#include <utility>

#include "datmo_fusion/common/waiting_bound.h"
#include "datmo_fusion/tracking/kalman_filter.h"
#include "datmo_fusion/tracking/object_check.h"

namespace datmo {

namespace {

/// s; a class that is older says little about what is to be decided now.
constexpr double kMaxAge = 0.5;

}  // namespace

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
  while (!scans_.empty() && secondsBetween(scans_.front().stamp, stamp) > kMaxAge) {
    known = std::move(scans_.front());  // whose memory is reused
    scans_.pop_front();
  }
  known.objects.clear();
  known.stamp = stamp;
  known.base_in_fixed = scan.fixed_in_base.inverse();
  for (const BestTarget& best : targets) {
    const std::size_t index = best.target->measurementIndex();
    if (index == kUnseen) {
      continue;
    }
    for (const std::size_t source : scan.observations[index].sources) {
      const Object& object = scan.observations[source].object;
      known.objects.push_back(
          {object.box.center.position(), object.position_covariance, best.target->number()});
    }
  }
  scans_.push_back(std::move(known));
}

std::vector<TargetClass> LateClasses::take() {
  std::vector<TargetClass> matched;
  while (!waiting_.empty() && !scans_.empty() && waiting_.front().stamp <= scans_.back().stamp) {
    const ObjectList& classes = waiting_.front();
    const auto scan = std::find_if(scans_.begin(), scans_.end(), [&classes](const KnownScan& one) {
      return one.stamp == classes.stamp;
    });
    if (scan != scans_.end()) {
      match(classes, *scan, matched);
    } else {
      counts_.without_target += classes.objects.size();
    }
    waiting_.pop_front();
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
    if (nearest == nullptr) {
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
