#include "datmo_fusion/tracking/association.h"

#include <cmath>

#include "datmo_fusion/common/uniform.h"
#include "datmo_fusion/tracking/assignment.h"

namespace datmo {

namespace {

Association named(const std::vector<int>& object_of_target, std::size_t objects) {
  Association result;
  std::vector<bool> explained(objects, false);
  for (std::size_t target = 0; target < object_of_target.size(); ++target) {
    if (object_of_target[target] == kUnassigned) {
      result.missed.push_back(target);
      continue;
    }
    const auto object = static_cast<std::size_t>(object_of_target[target]);
    result.pairs.push_back({target, object});
    explained[object] = true;
  }
  for (std::size_t object = 0; object < objects; ++object) {
    if (!explained[object]) {
      result.unexplained.push_back(object);
    }
  }
  return result;
}

/// Most that the target adds to the variance of an innovation along any direction, m^2: a
/// covariance has no more than its trace, and a box no more hidden than all of it
/// (TrackedBox::measurementOf).
double mostVariance(const Target& target) {
  const Box2 box = target.box();
  const double hidden = box.length * box.length + box.width * box.width;
  return target.filter().estimate().covariance.topLeftCorner<2, 2>().trace() +
         kUniformVariance * hidden;
}

}  // namespace

void AssociationOptions::visit(OptionVisitor& visitor) {
  visitor.number({"gate", "1",
                  "largest Mahalanobis distance squared between an object and a target: 13.8 is "
                  "the 99.9 % quantile of chi-square with two degrees of freedom"},
                 gate, {0.1, 1000.0});
  visitor.number(
      {"birth_density", "1/m^2",
       "objects of no target in one scan, over the odds that a target is seen: an object "
       "must be likelier for its target"},
      birth_density, {1e-9, 10.0});
}

Association GlobalNearestNeighbour::associate(const std::vector<Target>& targets,
                                              const std::vector<Object>& objects) const {
  CostMatrix costs(targets.size(), objects.size());
  costs.setConstant(kForbidden);
  for (std::size_t target = 0; target < targets.size(); ++target) {
    const Point2 place = targets[target].filter().estimate().mean.head<2>();
    const double variance = mostVariance(targets[target]);
    for (std::size_t object = 0; object < objects.size(); ++object) {
      // Most pairs are so far apart that nothing more needs to be known of them.
      const double distance2 = (objects[object].box.centre.position() - place).squaredNorm();
      if (distance2 <= options_.gate * (variance + objects[object].position_covariance.trace())) {
        costs(static_cast<Eigen::Index>(target), static_cast<Eigen::Index>(object)) =
            cost(targets[target], objects[object]);
      }
    }
  }
  // Costs are relative to a miss and a birth, which so cost nothing.
  const Eigen::VectorXd no_cost = Eigen::VectorXd::Zero(costs.rows());
  return named(solveAssignment(costs, no_cost).column_of_row, objects.size());
}

double GlobalNearestNeighbour::cost(const Target& target, const Object& object) const {
  if (!target.mayBe(object)) {
    return kForbidden;
  }
  const PositionMeasurement measured = target.measurementOf(object);
  if (innovationOf(target.filter().estimate(), measured).squaredDistance() > options_.gate) {
    return kForbidden;
  }
  return std::log(options_.birth_density) - target.filter().logLikelihood(measured);
}

}  // namespace datmo
