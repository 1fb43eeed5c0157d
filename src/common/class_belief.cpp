// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/common/class_belief.h"

#include <algorithm>
#include <functional>
#include <numeric>

namespace datmo {

namespace {

constexpr double kChance = 1.0 / static_cast<double>(kObjectClasses);

/// Share of the uniform distribution that is mixed in with every observation: no class falls below
/// a fifth of it, so that two or three clear observations overturn any belief.
constexpr double kDoubt = 0.05;

constexpr double kKnown = 0.5;

std::size_t indexOf(ObjectClass object_class) { return static_cast<std::size_t>(object_class); }

/// Normalizes relative probabilities and mixes in the doubt; all zeros become uniform.
ClassProbabilities normalizedWithDoubt(ClassProbabilities relative) {
  const double sum = std::accumulate(relative.begin(), relative.end(), 0.0);
  for (double& value : relative) {
    value = sum > 0.0 ? (1.0 - kDoubt) * value / sum + kDoubt * kChance : kChance;
  }
  return relative;
}

bool saysNothing(const ClassProbabilities& belief) {
  return std::all_of(belief.begin(), belief.end(), [](double one) { return one <= 0.0; });
}

/// Normalizes; all zeros become uniform.
ClassProbabilities normalized(ClassProbabilities relative) {
  const double total = std::accumulate(relative.begin(), relative.end(), 0.0);
  for (double& probability : relative) {
    probability = total > 0.0 ? probability / total : kChance;
  }
  return relative;
}

/// The belief, or uniform probabilities if it carries no information.
ClassProbabilities orEqual(const ClassProbabilities& belief) {
  return saysNothing(belief) ? normalized(belief) : belief;
}

}  // namespace

ClassProbabilities ofEachClass(const RoadUserLikelihoods& likelihoods) {
  const double mean = (likelihoods.pedestrian + likelihoods.cyclist + likelihoods.vehicle) / 3.0;
  ClassProbabilities result;
  result.fill(1.0);
  result[indexOf(ObjectClass::kPedestrian)] = likelihoods.pedestrian / mean;
  result[indexOf(ObjectClass::kCyclist)] = likelihoods.cyclist / mean;
  result[indexOf(ObjectClass::kVehicle)] = likelihoods.vehicle / mean;
  return result;
}

ClassProbabilities posterior(ClassProbabilities said, const ClassProbabilities& factors) {
  said = orEqual(said);
  std::transform(said.begin(), said.end(), factors.begin(), said.begin(), std::multiplies<>());
  return normalized(said);
}

ClassProbabilities withoutFactors(ClassProbabilities weighed, const ClassProbabilities& factors) {
  weighed = orEqual(weighed);
  std::transform(weighed.begin(), weighed.end(), factors.begin(), weighed.begin(),
                 std::divides<>());
  return normalized(weighed);
}

ClassProbabilities jointBelief(const std::vector<ClassProbabilities>& beliefs) {
  if (beliefs.size() == 1) {
    return orEqual(beliefs.front());
  }
  ClassProbabilities product;
  product.fill(1.0);
  for (const ClassProbabilities& one : beliefs) {
    const ClassProbabilities belief = orEqual(one);
    std::transform(belief.begin(), belief.end(), product.begin(), product.begin(),
                   std::multiplies<>());
  }
  return normalizedWithDoubt(product);
}

bool tellsAnything(const ClassProbabilities& belief) {
  return *std::max_element(belief.begin(), belief.end()) > kChance + kDoubt;
}

ClassBelief::ClassBelief() { probabilities_.fill(kChance); }

void ClassBelief::update(ObjectClass observed, double probability) {
  if (observed == ObjectClass::kUnknown || probability <= kChance) {
    return;
  }
  const double other = (1.0 - probability) / static_cast<double>(kObjectClasses - 1);
  for (std::size_t i = 0; i < kObjectClasses; ++i) {
    probabilities_[i] *= i == indexOf(observed) ? probability : other;
  }
  probabilities_ = normalizedWithDoubt(probabilities_);
}

double ClassBelief::probability(ObjectClass object_class) const {
  return probabilities_[indexOf(object_class)];
}

ObjectClass ClassBelief::mostLikely() const {
  const auto best = std::max_element(probabilities_.begin(), probabilities_.end());
  return static_cast<ObjectClass>(best - probabilities_.begin());
}

bool ClassBelief::compatible(ObjectClass object_class) const {
  const ObjectClass own = mostLikely();
  return object_class == ObjectClass::kUnknown || own == ObjectClass::kUnknown ||
         own == object_class || probability(own) <= kKnown;
}

}  // namespace datmo
