#include "datmo_fusion/tracking/association.h"

#include <cmath>

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
  for (std::size_t target = 0; target < targets.size(); ++target) {
    for (std::size_t object = 0; object < objects.size(); ++object) {
      costs(static_cast<Eigen::Index>(target), static_cast<Eigen::Index>(object)) =
          cost(targets[target], objects[object]);
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
