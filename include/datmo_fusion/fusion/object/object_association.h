// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "datmo_fusion/common/object.h"
#include "datmo_fusion/common/options.h"

namespace datmo {

/// How objects of two sensors are associated (associate).
enum class ObjectAssociationMethod { kOptimal, kNearestNeighbor };

struct ObjectAssociationOptions {
  ObjectAssociationMethod association = ObjectAssociationMethod::kOptimal;
  double gate = 13.8;                ///< 1
  double unrelated_density = 0.002;  ///< 1/m^2
  /// m/s, 0 to 100: standard deviation of the speed of moving objects between the stamps of two
  /// sensors; objects known to be stationary have none
  double object_speed = 10.0;
  double body_std = 0.2;          ///< m
  double unknown_size_std = 1.0;  ///< m
  int max_work = 2000000;
  double min_distance = 5.0;  ///< m
  double min_range = 36.0;    ///< m

  void visit(OptionVisitor& visitor);
};

/// Result of comparing two objects of different sensors.
struct ObjectPairing {
  bool possible = false;          ///< within the gate, and not of different known classes
  double squared_distance = 0.0;  ///< 1, Mahalanobis
  double score = 0.0;             ///< log-likelihood ratio of "one object" against "two"
};

/// Compares, along the two axes of the more certain heading, the sides that both sensors saw.
/// Without a common side it uses the gap between the visible parts, which is weak evidence because
/// the size is unknown. Positions of moving objects may differ by `object_speed` times the time
/// between them, as a standard deviation. Symmetric.
ObjectPairing pairing(const Object& a, const Object& b, const ObjectAssociationOptions& options);

/// Returns for each object of `added` the index of the same object in `known`, or kUnassigned; no
/// index twice. All objects must be valid (isValid) and in one frame.
///
/// optimal: the most likely one-to-one assignment over all pairs (solveAssignment), by the scores
/// of `pairing`; a pair must be likelier than two separate objects.
///
/// nearest_neighbor: thesis 3.3.3; the nearest object, if the middles of the sides that face the
/// sensor are closer than `min_distance` times range / `min_range`. If several choose the same
/// object, the nearest one gets it. Classes are ignored.
///
/// @param sensor m, sensor position of `added`, from which ranges are measured and near sides seen
std::vector<int> associate(const std::vector<Object>& known, const std::vector<Object>& added,
                           const Point2& sensor, const ObjectAssociationOptions& options);

}  // namespace datmo
