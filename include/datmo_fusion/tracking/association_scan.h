// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "datmo_fusion/common/class_belief.h"
#include "datmo_fusion/common/object.h"
#include "datmo_fusion/common/options.h"
#include "datmo_fusion/tracking/center_gate.h"
#include "datmo_fusion/tracking/clutter_map.h"
#include "datmo_fusion/tracking/transition_model.h"
#include "datmo_fusion/visibility/visibility.h"

namespace datmo {

/// The target that an observation may be of.
enum class ObservedTarget {
  kKnownOrNew,   ///< it starts a target if it belongs to none
  kKnownOrNone,  ///< a false alarm, or of no interest, if it belongs to none
  kKnown         ///< it must belong to a target
};

/// A possible measurement of one target in one scan: an object of the scan; several of them that
/// are parts of one object; or a part of an object that consists of several.
struct Observation {
  Observation(Object seen, std::vector<std::size_t> made_from, double density = 0.0,
              ObservedTarget of = ObservedTarget::kKnownOrNew)
      : object(std::move(seen)),
        class_likelihoods(classLikelihoods(object.class_probabilities)),
        sources(std::move(made_from)),
        log_density(density),
        target(of) {}

  bool startsTarget() const { return target == ObservedTarget::kKnownOrNew; }
  bool needsTarget() const { return target == ObservedTarget::kKnown; }

  Object object;  ///< fixed frame
  /// classLikelihoods() of the object, computed once for all targets.
  std::optional<ClassProbabilities> class_likelihoods;
  std::vector<std::size_t> sources;  ///< the scan's objects that it was made from, ascending
  double log_density = 0.0;          ///< log of the density of such objects of no target, 1/m^2
  ObservedTarget target = ObservedTarget::kKnownOrNew;
};

/// One scan as used for association, in the fixed frame.
struct AssociationScan {
  /// First the single objects, by ascending x of their centers; then combinations and parts.
  std::vector<Observation> observations;
  std::vector<Point2> centers;      ///< of the single objects, for fast loops over many
  std::vector<CenterBound> bounds;  ///< of the same
  CenterBound bound;                ///< of all of them
  std::size_t objects = 0;          ///< number of single objects
  std::vector<std::size_t> listed;  ///< index of each object in the sensor's list
  double noise = 0.0;               ///< m, largest standard deviation of position and sides
  double extent = 0.0;              ///< m, largest diagonal of an object

  const Visibility* visibility = nullptr;  ///< vehicle's frame
  Pose2 fixed_in_base;
  const TransitionPriors* transition_priors = nullptr;  ///< null: jumps are not learned

  /// Returns the transition model of a new target of this class; none: that of the options.
  std::optional<TransitionModel> transitionsOf(ObjectClass object_class) const;

  /// Returns the indices of an observation's sources in the sensor's list, ascending.
  std::vector<std::size_t> listedSources(std::size_t observation) const;
};

struct ScanIntakeOptions {
  double new_density = 2.5e-4;  ///< 1/m^2
  int max_objects = 500;

  void visit(OptionVisitor& visitor);
};

/// Counts over the objects of all lists.
struct ScanIntakeCounts {
  std::uint64_t accepted = 0;
  std::uint64_t rejected = 0;  ///< see isValid()
  std::uint64_t refused = 0;   ///< beyond the maximum of a list: the farthest
};

/// Prepares the objects of one time, in the vehicle's frame, for association. `visibility` must
/// outlive the scan. The order of the objects does not matter.
AssociationScan ingest(const std::vector<Object>& objects, const Pose2& base_in_fixed,
                       const Visibility& visibility, const ClutterMap& clutter,
                       const ScanIntakeOptions& options, ScanIntakeCounts& counts);

}  // namespace datmo
