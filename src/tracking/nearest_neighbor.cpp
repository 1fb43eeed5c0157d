// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/tracking/nearest_neighbor.h"

#include <algorithm>

#include "datmo_fusion/assignment/assignment.h"
#include "datmo_fusion/common/disjoint_sets.h"

namespace datmo {

NearestNeighborTargets::NearestNeighborTargets(const TargetOptions& target,
                                               const AssociationOptions& association)
    : target_options_(target), steps_(target.filter), options_(association) {}

std::unique_ptr<TargetSet> NearestNeighborTargets::clone() const {
  return std::make_unique<NearestNeighborTargets>(*this);
}

void NearestNeighborTargets::predict(double seconds, const AssociationScan& scan) {
  const ImmSteps& steps = steps_.of(seconds);
  for (ScoredTarget& next : targets_) {
    Target& target = *next.target;
    target.predict(seconds, steps, target_options_);
    next.scores = scoresOf(target, scan, target.existenceProbability(target_options_), options_,
                           std::move(next.scores));
  }
}

void NearestNeighborTargets::associate(AssociationScan& scan, const StepBudget& /*budget*/) {
  const std::vector<int> object_of_target = assign(scan.objects);

  std::vector<bool> explained(scan.objects, false);
  for (std::size_t i = 0; i < targets_.size(); ++i) {
    const double seen = targets_[i].scores.detection_probability;
    if (object_of_target[i] == kUnassigned) {
      targets_[i].target->miss(seen, target_options_);
      continue;
    }
    const auto object = static_cast<std::size_t>(object_of_target[i]);
    targets_[i].target->update(scan.observations[object], object, seen, target_options_);
    explained[object] = true;
  }
  startTargets(scan, explained);
  next_number_ += scan.objects;
}

std::vector<int> NearestNeighborTargets::assign(std::size_t objects) {
  const std::size_t targets = targets_.size();
  DisjointSets groups(targets + objects);  // targets first, then objects
  for (std::size_t i = 0; i < targets; ++i) {
    for (const Candidate& candidate : targets_[i].scores.candidates) {
      groups.join(i, targets + candidate.observation);
    }
  }
  std::vector<int> object_of_target(targets, kUnassigned);
  std::int64_t work = options_.max_work;
  bool cut = false;
  for (const std::vector<std::size_t>& group : groups.sets(2)) {
    const auto rows = std::lower_bound(group.begin(), group.end(), targets) - group.begin();
    const auto columns = static_cast<std::ptrdiff_t>(group.size()) - rows;
    CostMatrix costs(rows, columns);
    costs.setConstant(kForbidden);
    for (std::ptrdiff_t row = 0; row < rows; ++row) {
      for (const Candidate& candidate :
           targets_[group[static_cast<std::size_t>(row)]].scores.candidates) {
        const auto column =
            std::lower_bound(group.begin() + rows, group.end(), targets + candidate.observation);
        costs(row, column - group.begin() - rows) = -candidate.score;
      }
    }
    // Costs are relative to a missed target and a new one, which therefore cost nothing.
    const Eigen::VectorXd no_cost = Eigen::VectorXd::Zero(rows);
    const Assignment assignment = solveAssignment(costs, no_cost, std::max<std::int64_t>(0, work));
    cut = cut || assignment.cut;
    work -= assignment.work;
    for (std::ptrdiff_t row = 0; row < rows; ++row) {
      const int column = assignment.column_of_row[static_cast<std::size_t>(row)];
      if (column != kUnassigned) {
        const std::size_t object = group[static_cast<std::size_t>(rows + column)] - targets;
        object_of_target[group[static_cast<std::size_t>(row)]] = static_cast<int>(object);
      }
    }
  }
  counts_.cut_hypotheses += cut ? 1 : 0;
  return object_of_target;
}

void NearestNeighborTargets::startTargets(const AssociationScan& scan,
                                          const std::vector<bool>& explained) {
  for (std::size_t object = 0; object < scan.objects; ++object) {
    const Observation& observation = scan.observations[object];
    if (explained[object] || !observation.startsTarget()) {
      continue;
    }
    if (targets_.size() >= static_cast<std::size_t>(options_.max_targets)) {
      ++counts_.refused_births;
      continue;
    }
    targets_.emplace_back(
        std::make_unique<Target>(observation.object, object, next_number_ + object, target_options_,
                                 scan.transitionsOf(observation.object.objectClass())));
  }
}

const std::vector<BestTarget>& NearestNeighborTargets::best() const {
  best_.clear();
  for (const ScoredTarget& next : targets_) {
    best_.push_back({next.target.get(), 1.0});
  }
  return best_;
}

void NearestNeighborTargets::change(std::uint64_t number,
                                    const std::function<void(Target&)>& change) {
  for (const ScoredTarget& next : targets_) {
    if (next.target->number() == number) {
      change(*next.target);
    }
  }
}

void NearestNeighborTargets::removeIf(const std::function<bool(const Target&)>& isLost) {
  targets_.erase(std::remove_if(targets_.begin(), targets_.end(),
                                [&](const ScoredTarget& next) { return isLost(*next.target); }),
                 targets_.end());
}

}  // namespace datmo
