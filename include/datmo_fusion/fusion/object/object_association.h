// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "datmo_fusion/common/object.h"
#include "datmo_fusion/common/options.h"

namespace datmo {

/// Which objects of two sensors are one (associate).
enum class ObjectAssociationMethod { kOptimal, kNearestNeighbor };

struct ObjectAssociationOptions {
  ObjectAssociationMethod association = ObjectAssociationMethod::kOptimal;
  double gate = 13.8;                ///< 1
  double unrelated_density = 0.002;  ///< 1/m^2
  double object_speed = 10.0;        ///< m/s
  double body_std = 0.2;             ///< m
  double unknown_size_std = 1.0;     ///< m
  int max_work = 2000000;
  double min_distance = 5.0;  ///< m
  double min_range = 36.0;    ///< m

  void visit(OptionVisitor& visitor);
};

/// What two objects of different sensors have in common, taken for one.
struct ObjectPairing {
  bool possible = false;          ///< within the gate, and not of different classes
  double squared_distance = 0.0;  ///< 1, Mahalanobis
  double score = 0.0;             ///< log-likelihood ratio of "one object" against "two"
};

/// Compares along each of two axes (those of the surer heading) the sides that both saw; where no
/// side is common, how far apart the visible parts are, which is weak evidence, for the size is
/// not known. Positions of moving objects may differ by `object_speed` times the seconds
/// between them, as a standard deviation. Symmetric.
ObjectPairing pairing(const Object& a, const Object& b, const ObjectAssociationOptions& options);

/// For each of `added` the one of `known` that is the same object, or kUnassigned; no one twice.
/// All valid (isValid), in one frame.
///
/// optimal: the assignment that is likeliest over all pairs (solveAssignment), at the scores of
/// `pairing`; a pair must be likelier than two objects.
///
/// nearest_neighbor: thesis 3.3.3; the nearest one, where the middle of the side that faces the
/// sensor is nearer than `min_distance` times range / `min_range`. Of several that have the
/// same nearest one the nearest keeps it. No classes.
///
/// @param sensor m, of `added`, from where ranges are counted and near sides are seen
std::vector<int> associate(const std::vector<Object>& known, const std::vector<Object>& added,
                           const Point2& sensor, const ObjectAssociationOptions& options);

}  // namespace datmo
