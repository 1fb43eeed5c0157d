// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "tracking_scene.h"

#include "datmo_fusion/tracking/association_scan.h"
#include "datmo_fusion/tracking/target.h"
#include "datmo_fusion/tracking/target_set.h"

namespace datmo {

/// Makes scans for the association; view and clutter are unknown.
class ScanSource {
 public:
  /// Returns a scan, which must not outlive this source.
  AssociationScan scan(const std::vector<Object>& objects) {
    return ingest(objects, Pose2(), visibility_, clutter_, ScanIntakeOptions(), counts_);
  }

  double detectionProbability() const { return VisibilityOptions().unknown_probability; }
  double density() const { return ScanIntakeOptions().new_density; }

 private:
  Visibility visibility_{VisibilityOptions()};
  ClutterMap clutter_{ClutterMapOptions()};
  ScanIntakeCounts counts_;
};

/// A target that was just seen for the first time, at (x, y) in m.
inline Target targetAt(double x, double y, std::uint64_t number = 1) {
  return {objectAt(x, y), 0, number, TargetOptions()};
}

/// The same 0.1 s later.
inline Target predictedAt(double x, double y, std::uint64_t number = 1) {
  const TargetOptions options;
  Target target = targetAt(x, y, number);
  target.predict(0.1, immSteps(options.filter, 0.1), options);
  return target;
}

inline std::vector<Object> objectsAlong(const std::vector<double>& positions) {
  std::vector<Object> objects;
  for (const double x : positions) {
    objects.push_back(objectAt(x, 0.0));
  }
  return objects;
}

/// Passes whole scans to a set of targets, 0.1 s apart.
inline void see(TargetSet& targets, ScanSource& source, const std::vector<Object>& objects,
                const StepBudget& budget = StepBudget()) {
  AssociationScan scan = source.scan(objects);
  targets.predict(0.1, scan);
  targets.associate(scan, budget);
}

/// Returns the observation of the target of this number in the last scan; kUnseen also if there is
/// none.
inline std::size_t measurementIndex(const TargetSet& targets, std::uint64_t number) {
  for (const BestTarget& best : targets.best()) {
    if (best.target->number() == number) {
      return best.target->measurementIndex();
    }
  }
  return kUnseen;
}

}  // namespace datmo
