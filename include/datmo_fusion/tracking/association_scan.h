// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "datmo_fusion/common/object.h"
#include "datmo_fusion/common/options.h"
#include "datmo_fusion/tracking/center_gate.h"
#include "datmo_fusion/tracking/clutter_map.h"
#include "datmo_fusion/tracking/transition_model.h"
#include "datmo_fusion/visibility/visibility.h"

namespace datmo {

/// What one target may have been seen as in one scan: an object of the scan; several of them, which
/// are parts of one object; or a part of one, which is several objects.
struct Observation {
  Object object;                     ///< fixed frame
  std::vector<std::size_t> sources;  ///< the scan's objects that it was made of, rising
  double log_density = 0.0;          ///< of such objects that are of no target, 1/m^2
  bool starts_target = true;         ///< if it is of none
  bool needs_target = false;         ///< it makes no sense without one
};

/// One scan as the association sees it, in the fixed frame.
struct AssociationScan {
  /// First the objects by themselves, by rising x of their centers; then what else they may be.
  std::vector<Observation> observations;
  std::vector<Point2> centers;      ///< of the objects by themselves: to look through many of them
  std::vector<CenterBound> bounds;  ///< of the same
  CenterBound bound;                ///< of all of them
  std::size_t objects = 0;          ///< how many are objects by themselves
  std::vector<std::size_t> listed;  ///< where each object stood in the sensor's list
  double noise = 0.0;               ///< m, largest standard deviation of position and sides
  double extent = 0.0;              ///< m, largest diagonal of an object

  const Visibility* visibility = nullptr;  ///< vehicle's frame
  Pose2 fixed_in_base;
  const TransitionPriors* transition_priors = nullptr;  ///< null: nothing is learned of jumps

  /// How a new target of this class changes between motion modes; none: by the options alone.
  std::optional<TransitionModel> transitionsOf(ObjectClass object_class) const;

  /// Where the sources of an observation stood in the sensor's list, rising.
  std::vector<std::size_t> listedSources(std::size_t observation) const;
};

struct ScanIntakeOptions {
  double new_density = 2.5e-4;  ///< 1/m^2
  int max_objects = 500;

  void visit(OptionVisitor& visitor);
};

/// What became of the objects of all lists.
struct ScanIntakeCounts {
  std::uint64_t accepted = 0;
  std::uint64_t rejected = 0;  ///< see isValid()
  std::uint64_t refused = 0;   ///< beyond the most of one list: the farthest
};

/// Takes in the objects of one time, in the vehicle's frame. `visibility` must outlive the scan.
/// The order of the objects does not matter.
AssociationScan ingest(const std::vector<Object>& objects, const Pose2& base_in_fixed,
                       const Visibility& visibility, const ClutterMap& clutter,
                       const ScanIntakeOptions& options, ScanIntakeCounts& counts);

}  // namespace datmo
