// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/tracking/nearest_neighbor.h"

#include <algorithm>

#include "datmo_fusion/assignment/assignment.h"

namespace datmo {

NearestNeighborTargets::NearestNeighborTargets(const TargetOptions& target,
                                               const AssociationOptions& association)
    : target_options_(target), options_(association) {}

void NearestNeighborTargets::predict(double seconds) {
  const ImmSteps steps = immSteps(target_options_.filter, seconds);
  for (Target& target : targets_) {
    target.predict(seconds, steps, target_options_);
  }
}

void NearestNeighborTargets::associate(AssociationScan& scan, const StepBudget& /*budget*/) {
  std::vector<TargetScores> scores;
  CostMatrix costs(targets_.size(), scan.objects);
  costs.setConstant(kForbidden);
  for (const Target& target : targets_) {
    scores.push_back(
        scoresOf(target, scan, target.existenceProbability(target_options_), options_));
    for (const Candidate& candidate : scores.back().candidates) {
      costs(static_cast<Eigen::Index>(scores.size() - 1),
            static_cast<Eigen::Index>(candidate.observation)) = -candidate.score;
    }
  }
  // Costs are relative to a miss and a birth, which so cost nothing.
  const Eigen::VectorXd no_cost = Eigen::VectorXd::Zero(costs.rows());
  const Assignment assignment = solveAssignment(costs, no_cost, options_.max_work);
  counts_.cut_hypotheses += assignment.cut ? 1 : 0;
  const std::vector<int>& object_of_target = assignment.column_of_row;

  std::vector<bool> explained(scan.objects, false);
  for (std::size_t i = 0; i < targets_.size(); ++i) {
    const double seen = scores[i].detection_probability;
    if (object_of_target[i] == kUnassigned) {
      targets_[i].miss(seen, target_options_);
      continue;
    }
    const auto object = static_cast<std::size_t>(object_of_target[i]);
    targets_[i].update(scan.observations[object], object, seen, target_options_);
    explained[object] = true;
  }
  startTargets(scan, explained);
  next_number_ += scan.objects;
}

void NearestNeighborTargets::startTargets(const AssociationScan& scan,
                                          const std::vector<bool>& explained) {
  for (std::size_t object = 0; object < scan.objects; ++object) {
    const Observation& observation = scan.observations[object];
    if (explained[object] || !observation.starts_target) {
      continue;
    }
    if (targets_.size() >= static_cast<std::size_t>(options_.max_targets)) {
      ++counts_.refused_births;
      continue;
    }
    targets_.emplace_back(observation.object, object, next_number_ + object, target_options_,
                          scan.transitionsOf(observation.object.object_class));
  }
}

std::vector<BestTarget> NearestNeighborTargets::best() const {
  std::vector<BestTarget> result;
  for (const Target& target : targets_) {
    result.push_back({&target, 1.0});
  }
  return result;
}

void NearestNeighborTargets::change(std::uint64_t number,
                                    const std::function<void(Target&)>& change) {
  for (Target& target : targets_) {
    if (target.number() == number) {
      change(target);
    }
  }
}

void NearestNeighborTargets::removeIf(const std::function<bool(const Target&)>& isLost) {
  targets_.erase(std::remove_if(targets_.begin(), targets_.end(), isLost), targets_.end());
}

}  // namespace datmo
