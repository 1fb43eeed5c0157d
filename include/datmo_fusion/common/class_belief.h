// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "datmo_fusion/common/object.h"

namespace datmo {

/// Returns the class with the highest probability; on a tie the first in the order of ObjectClass,
/// so kUnknown if nothing is known.
ObjectClass mostLikelyClass(const ClassProbabilities& probabilities);

double probabilityOf(ObjectClass object_class, const ClassProbabilities& probabilities);

/// Returns Object::class_probabilities of a sensor that reports one class and the probability (0 to
/// 1) that it is right; all 0 for kUnknown.
ClassProbabilities reportedClass(ObjectClass object_class, double probability);

/// Returns the likelihood of an observation (Object::class_probabilities) for each class,
/// normalized to sum 1; none if it is no evidence for a class: the most likely one is unknown, or
/// not likelier than by chance (one in kObjectClasses). Probability mass that is missing
/// to 1 is spread evenly over all classes but the most likely one. Objects of unknown class cause
/// the observation as often, on average, as those of known classes other than the most likely one:
/// that an object is none of the known classes is expressed by its existence probability instead.
std::optional<ClassProbabilities> classLikelihoods(const ClassProbabilities& observed);

/// Returns the combined belief of independent ones (Bayes), in any order. Each started from a
/// uniform prior, so their product is the posterior. As in ClassBelief, no class becomes
/// impossible. If the beliefs contradict each other completely, or there are none, all classes are
/// equally likely. A single belief is returned unchanged. One of all zeros, as in the tracks of a
/// source that does not report classes, is the same as all equal.
ClassProbabilities jointBelief(const std::vector<ClassProbabilities>& beliefs);

/// Likelihoods of a measurement given each of the three kinds of road users, up to a common factor;
/// each is at least 0, and at least one is positive.
struct RoadUserLikelihoods {
  double pedestrian;
  double cyclist;
  double vehicle;
};

/// Returns the likelihood of each class relative to the mean of the three; the mean itself (1) for
/// any other class.
ClassProbabilities ofEachClass(const RoadUserLikelihoods& likelihoods);

/// Multiplies a belief by one factor per class (Bayes): `reported` comes from classifiers,
/// `factors` from other measurements. withoutFactors() divides them out again. The results sum
/// to 1.
ClassProbabilities posterior(ClassProbabilities reported, const ClassProbabilities& factors);
ClassProbabilities withoutFactors(ClassProbabilities weighted, const ClassProbabilities& factors);

/// Returns whether one class exceeds chance by more than the doubt that ClassBelief keeps.
bool isInformative(const ClassProbabilities& belief);

/// Class of an object, estimated from all class reports so far (Bayes). The prior is uniform.
///
/// No class ever becomes impossible: a classifier that errs once tends to err on the same object
/// again, so its reports are not independent, and the belief must be able to recover.
class ClassBelief {
 public:
  ClassBelief();

  /// Updates with one observation: Object::class_probabilities. One without classLikelihoods() is
  /// ignored.
  void update(const ClassProbabilities& observed);

  const ClassProbabilities& probabilities() const { return probabilities_; }
  double probability(ObjectClass object_class) const;

  /// Returns the most likely class; kUnknown before any observation.
  ObjectClass mostLikely() const;

  /// Returns whether an object of this class may be the same one: false if both classes are known
  /// and differ (thesis 3.3.4). A belief is known if one class is likelier than all others
  /// together.
  bool compatible(ObjectClass object_class) const;

 private:
  ClassProbabilities probabilities_;
};

}  // namespace datmo
