// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <deque>
#include <vector>

#include <Eigen/Core>

#include "datmo_fusion/common/object.h"
#include "datmo_fusion/common/pose2.h"
#include "datmo_fusion/common/stamp.h"
#include "datmo_fusion/tracking/association_scan.h"
#include "datmo_fusion/tracking/target_set.h"

namespace datmo {

/// The class that a target's object was given.
struct TargetClass {
  std::uint64_t number;  ///< of the target
  ClassProbabilities probabilities;
};

/// Counts since construction or clear().
struct LateClassCounts {
  std::uint64_t rejected = 0;        ///< see isValid()
  std::uint64_t without_target = 0;  ///< their objects belonged to no target, or are too old
};

/// Gives classes that arrive late, as those of a slow detector in images, to the targets to which
/// their objects belonged at the time of the detection. Where these targets are by now does not
/// matter: two that have passed each other in the meantime are not confused.
///
/// Which object belongs to which target is remembered for `kMaxAge`, by the most likely hypothesis
/// of that time.
class LateClasses {
 public:
  /// s; an older class says little about what is to be decided now.
  static constexpr double kMaxAge = 0.5;

  /// `gate`: squared Mahalanobis distance within which an object that was fused with those of other
  /// sensors is still the same one.
  explicit LateClasses(double gate) : gate_(gate) {}

  /// Adds the classes of one time: the objects that the scanner listed then, in the vehicle's
  /// frame, with their classes.
  void add(ObjectList classes);

  /// Remembers the targets of a scan's objects.
  void note(Stamp stamp, const std::vector<BestTarget>& targets, const AssociationScan& scan);

  /// Takes the classes whose scans are known by now: at most one per target and list, that of the
  /// nearest object. Those of later scans stay.
  std::vector<TargetClass> take();

  const LateClassCounts& counts() const { return counts_; }

  void clear();

 private:
  struct KnownObject {
    Point2 position;             ///< m, fixed frame
    Eigen::Matrix2d covariance;  ///< m^2
    std::uint64_t target;        ///< its number; 0: none
  };
  struct KnownScan {
    Stamp stamp;
    Pose2 base_in_fixed;
    std::vector<KnownObject> objects;
  };

  void match(const ObjectList& classes, const KnownScan& scan, std::vector<TargetClass>& matched);

  double gate_;
  std::deque<KnownScan> scans_;     ///< by rising stamp; bounded
  std::deque<ObjectList> waiting_;  ///< by arrival
  LateClassCounts counts_;
};

}  // namespace datmo
