// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/fusion/object/object_association.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "object_sides.h"
#include <Eigen/LU>

#include "datmo_fusion/assignment/assignment.h"
#include "datmo_fusion/common/angle.h"
#include "datmo_fusion/common/class_belief.h"
#include "datmo_fusion/common/square.h"

namespace datmo {

namespace {

/// m^2, minimum variance of the difference between two sides: keeps weights finite.
constexpr double kMinDifferenceVariance = 1e-8;

bool standsStill(const Object& object) { return object.dynamic_state == DynamicState::kStatic; }

/// m^2, of a possible motion between the times of the two observations.
double motionVariance(const Object& a, const Object& b, const ObjectAssociationOptions& options) {
  return standsStill(a) || standsStill(b) ? 0.0
                                          : square(options.object_speed * (b.delay - a.delay));
}

ClassBelief beliefOf(const Object& object) {
  ClassBelief belief;
  belief.update(object.class_probabilities);
  return belief;
}

/// False if both classes are known and differ.
bool mayBeOfOneClass(const Object& a, const Object& b) {
  return beliefOf(a).compatible(b.objectClass()) || beliefOf(b).compatible(a.objectClass());
}

/// An object that the scan knows to be static does not match one that may move: a person beside a
/// tree or a parked car, or an echo of the curb below it.
bool onlyOneIsStatic(const Object& a, const Object& b) { return standsStill(a) != standsStill(b); }

/// Difference between two objects along an axis, m, and its variance, m^2, without that of the
/// positions as a whole.
struct Difference {
  double value;
  double variance;
};

Difference differenceOf(const SidePair& a, const SidePair& b, double unknown_size_variance) {
  double weights = 0.0;
  double weighted = 0.0;
  for (std::size_t end = 0; end < 2; ++end) {
    if (a.isSeen(end) && b.isSeen(end)) {
      const double weight =
          1.0 / std::max(a.variance[end] + b.variance[end], kMinDifferenceVariance);
      weights += weight;
      weighted += weight * (b.position[end] - a.position[end]);
    }
  }
  if (weights > 0.0) {
    return {weighted / weights, 1.0 / weights};
  }
  const double beyond = std::max(0.0, b.position[0] - a.position[1]);
  const double before = std::max(0.0, a.position[0] - b.position[1]);
  // If the sides that face each other were both seen, the gap between them is real.
  const std::size_t of_a = beyond > 0.0 ? 1 : 0;
  const bool bounded = beyond + before > 0.0 && a.isSeen(of_a) && b.isSeen(1 - of_a);
  return {beyond - before,
          bounded ? a.variance[of_a] + b.variance[1 - of_a] : unknown_size_variance};
}

/// Upper bounds for quickly rejecting a pair by distance.
struct Extent {
  double radius;    ///< m, of the sides from the center
  double variance;  ///< m^2, maximum variance of a side along any axis
};

Extent extentOf(const Object& object) {
  const double radius = object.box.halfDiagonal();
  double side = 0.0;
  for (const double variance : object.side_variance) {
    side = std::max(side, std::isfinite(variance) ? variance : 0.0);
  }
  // Rotated into other axes, by at most an eighth of a turn.
  const double turned = 0.5 * square(radius);
  return {radius, object.position_covariance.trace() + side + turned};
}

std::vector<Extent> extentsOf(const std::vector<Object>& objects) {
  std::vector<Extent> extents;
  extents.reserve(objects.size());
  for (const Object& object : objects) {
    extents.push_back(extentOf(object));
  }
  return extents;
}

std::vector<int> assignOptimally(const std::vector<Object>& known, const std::vector<Object>& added,
                                 const ObjectAssociationOptions& options) {
  const auto rows = static_cast<Eigen::Index>(added.size());
  const auto columns = static_cast<Eigen::Index>(known.size());
  CostMatrix cost = CostMatrix::Constant(rows, columns, kForbidden);
  const std::vector<Extent> extents_known = extentsOf(known);
  const std::vector<Extent> extents_added = extentsOf(added);
  const double of_pair = square(options.body_std) + square(options.unknown_size_std);
  for (std::size_t i = 0; i < added.size(); ++i) {
    for (std::size_t j = 0; j < known.size(); ++j) {
      // Most pairs are too far apart to need a closer look.
      const double variance = extents_added[i].variance + extents_known[j].variance + of_pair +
                              motionVariance(known[j], added[i], options);
      const double reach =
          std::sqrt(options.gate * variance) + extents_added[i].radius + extents_known[j].radius;
      const Point2 apart = added[i].box.center.position() - known[j].box.center.position();
      if (apart.squaredNorm() > reach * reach) {
        continue;
      }
      const ObjectPairing pair = pairing(known[j], added[i], options);
      if (pair.possible) {
        cost(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = -pair.score;
      }
    }
  }
  return solveAssignment(cost, Eigen::VectorXd::Zero(rows), options.max_work).column_of_row;
}

/// Middle of the side nearest to the sensor (thesis 3.3.2: of the front line segment).
Point2 nearMiddle(const Box2& box, const Point2& sensor) {
  Point2 nearest = box.center.position();
  double min = std::numeric_limits<double>::infinity();
  for (const Point2& side : {Point2(0.5 * box.length, 0.0), Point2(-0.5 * box.length, 0.0),
                             Point2(0.0, 0.5 * box.width), Point2(0.0, -0.5 * box.width)}) {
    const Point2 middle = box.center * side;
    const double distance = (middle - sensor).norm();
    if (distance < min) {
      min = distance;
      nearest = middle;
    }
  }
  return nearest;
}

std::vector<int> assignNearest(const std::vector<Object>& known, const std::vector<Object>& added,
                               const Point2& sensor, const ObjectAssociationOptions& options) {
  std::vector<int> result(added.size(), kUnassigned);
  std::vector<double> distance(added.size(), 0.0);
  std::vector<int> owner(known.size(), kUnassigned);
  for (std::size_t i = 0; i < added.size(); ++i) {
    const Point2 position = nearMiddle(added[i].box, sensor);
    const double range = (position - sensor).norm();
    double min = options.min_distance * range / options.min_range;
    for (std::size_t j = 0; range <= options.min_range && j < known.size(); ++j) {
      const double apart = (nearMiddle(known[j].box, sensor) - position).norm();
      if (apart < min) {
        min = apart;
        result[i] = static_cast<int>(j);
      }
    }
    distance[i] = min;
    if (result[i] == kUnassigned) {
      continue;
    }
    int& owned = owner[static_cast<std::size_t>(result[i])];
    const int loser = owned == kUnassigned || min < distance[static_cast<std::size_t>(owned)]
                          ? std::exchange(owned, static_cast<int>(i))
                          : static_cast<int>(i);
    if (loser != kUnassigned) {
      result[static_cast<std::size_t>(loser)] = kUnassigned;
    }
  }
  return result;
}

}  // namespace

void ObjectAssociationOptions::visit(OptionVisitor& visitor) {
  visitor.choice({"association", "",
                  "how objects of two sensors are associated: the most likely assignment over all "
                  "pairs, or each to its nearest neighbor (thesis 3.3.3)"},
                 association,
                 {{"optimal", ObjectAssociationMethod::kOptimal},
                  {"nearest_neighbor", ObjectAssociationMethod::kNearestNeighbor}});
  visitor.number({"gate", "1",
                  "optimal: largest Mahalanobis distance squared of a pair: 13.8 is the 99.9 % "
                  "quantile of chi-square with two degrees of freedom"},
                 gate, {0.1, 1000.0});
  visitor.number({"unrelated_density", "1/m^2",
                  "optimal: density of objects of one sensor that the other does not see, around "
                  "an object: a pair must be likelier than one of them"},
                 unrelated_density, {1e-9, 10.0});
  visitor.number({"body_std", "m",
                  "optimal: standard deviation between the sides of a body that two sensors see at "
                  "different heights"},
                 body_std, {0.0, 10.0});
  visitor.number({"unknown_size_std", "m",
                  "optimal: standard deviation of how far an object extends beyond its visible "
                  "part: allowed where two sensors saw no side in common"},
                 unknown_size_std, {0.0, 20.0});
  visitor.integer({"max_work", "1",
                   "optimal: pairs, rows and columns examined (1 ns to 2 ns each) before the "
                   "remaining objects take the best free one"},
                  max_work, {1000, 1e9});
  visitor.number({"min_distance", "m",
                  "nearest_neighbor: two objects at min_range are one if they are closer than "
                  "this, others in proportion to their range (thesis 3.3.3: 5)"},
                 min_distance, {0.1, 100.0});
  visitor.number(
      {"min_range", "m", "nearest_neighbor: objects farther away are not associated (thesis: 36)"},
      min_range, {1.0, 1000.0});
}

ObjectPairing pairing(const Object& a, const Object& b, const ObjectAssociationOptions& options) {
  if (!mayBeOfOneClass(a, b) || onlyOneIsStatic(a, b)) {
    return {};
  }
  const CommonAxes axes(a, b, commonHeading(a, b));
  const ObjectSides sides_a = sidesIn(axes, a);
  const ObjectSides sides_b = sidesIn(axes, b);
  const double whole = square(options.body_std) + motionVariance(a, b, options);
  Eigen::Vector2d difference;
  Eigen::Matrix2d covariance = sides_a.covariance + sides_b.covariance;
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const Difference along =
        differenceOf(sides_a.along[axis], sides_b.along[axis], square(options.unknown_size_std));
    const auto i = static_cast<Eigen::Index>(axis);
    difference[i] = along.value;
    covariance(i, i) += along.variance + whole;
  }
  ObjectPairing result;
  result.squared_distance = difference.dot(covariance.inverse() * difference);
  result.possible = result.squared_distance <= options.gate;  // false for NaN
  result.score = -0.5 * result.squared_distance - 0.5 * std::log(covariance.determinant()) -
                 std::log(2.0 * kPi * options.unrelated_density);
  return result;
}

std::vector<int> associate(const std::vector<Object>& known, const std::vector<Object>& added,
                           const Point2& sensor, const ObjectAssociationOptions& options) {
  if (known.empty() || added.empty()) {
    return std::vector<int>(added.size(), kUnassigned);
  }
  return options.association == ObjectAssociationMethod::kOptimal
             ? assignOptimally(known, added, options)
             : assignNearest(known, added, sensor, options);
}

}  // namespace datmo
