// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/common/class_belief.h"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <numeric>
#include <optional>

namespace datmo {

namespace {

constexpr double kChance = 1.0 / static_cast<double>(kObjectClasses);

/// All but kUnknown, which is the first.
constexpr std::size_t kKnownClasses = kObjectClasses - 1;
constexpr std::size_t kFirstKnown = 1;
static_assert(static_cast<std::size_t>(ObjectClass::kUnknown) < kFirstKnown);

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

bool isUninformative(const ClassProbabilities& belief) {
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
  return isUninformative(belief) ? normalized(belief) : belief;
}

}  // namespace

ObjectClass mostLikelyClass(const ClassProbabilities& probabilities) {
  const auto best = std::max_element(probabilities.begin(), probabilities.end());
  return static_cast<ObjectClass>(best - probabilities.begin());
}

double probabilityOf(ObjectClass object_class, const ClassProbabilities& probabilities) {
  return probabilities[indexOf(object_class)];
}

ClassProbabilities reportedClass(ObjectClass object_class, double probability) {
  ClassProbabilities result{};
  if (object_class != ObjectClass::kUnknown) {
    result[indexOf(object_class)] = probability;
  }
  return result;
}

std::optional<ClassProbabilities> classLikelihoods(const ClassProbabilities& observed) {
  const ObjectClass most_likely = mostLikelyClass(observed);
  if (most_likely == ObjectClass::kUnknown || !(probabilityOf(most_likely, observed) > kChance)) {
    return std::nullopt;
  }
  const std::size_t best = indexOf(most_likely);
  const double sum = std::accumulate(observed.begin(), observed.end(), 0.0);
  const double missing = std::max(0.0, 1.0 - sum) / static_cast<double>(kObjectClasses - 1);
  ClassProbabilities result = observed;
  double others = 0.0;
  for (std::size_t i = kFirstKnown; i < kObjectClasses; ++i) {
    if (i != best) {
      result[i] += missing;
      others += result[i];
    }
  }
  result[indexOf(ObjectClass::kUnknown)] = others / static_cast<double>(kKnownClasses - 1);
  return normalized(result);
}

ClassProbabilities ofEachClass(const RoadUserLikelihoods& likelihoods) {
  const double mean = (likelihoods.pedestrian + likelihoods.cyclist + likelihoods.vehicle) / 3.0;
  ClassProbabilities result;
  result.fill(1.0);
  result[indexOf(ObjectClass::kPedestrian)] = likelihoods.pedestrian / mean;
  result[indexOf(ObjectClass::kCyclist)] = likelihoods.cyclist / mean;
  result[indexOf(ObjectClass::kVehicle)] = likelihoods.vehicle / mean;
  return result;
}

ClassProbabilities posterior(ClassProbabilities reported, const ClassProbabilities& factors) {
  reported = orEqual(reported);
  std::transform(reported.begin(), reported.end(), factors.begin(), reported.begin(),
                 std::multiplies<>());
  return normalized(reported);
}

ClassProbabilities withoutFactors(ClassProbabilities weighted, const ClassProbabilities& factors) {
  weighted = orEqual(weighted);
  std::transform(weighted.begin(), weighted.end(), factors.begin(), weighted.begin(),
                 std::divides<>());
  return normalized(weighted);
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

bool isInformative(const ClassProbabilities& belief) {
  return *std::max_element(belief.begin(), belief.end()) > kChance + kDoubt;
}

ClassBelief::ClassBelief() { probabilities_.fill(kChance); }

void ClassBelief::update(const ClassProbabilities& observed) {
  const std::optional<ClassProbabilities> likelihoods = classLikelihoods(observed);
  if (!likelihoods) {
    return;
  }
  std::transform(probabilities_.begin(), probabilities_.end(), likelihoods->begin(),
                 probabilities_.begin(), std::multiplies<>());
  probabilities_ = normalizedWithDoubt(probabilities_);
}

double ClassBelief::probability(ObjectClass object_class) const {
  return probabilityOf(object_class, probabilities_);
}

ObjectClass ClassBelief::mostLikely() const { return mostLikelyClass(probabilities_); }

bool ClassBelief::compatible(ObjectClass object_class) const {
  const ObjectClass own = mostLikely();
  return object_class == ObjectClass::kUnknown || own == ObjectClass::kUnknown ||
         own == object_class || probability(own) <= kKnown;
}

}  // namespace datmo
