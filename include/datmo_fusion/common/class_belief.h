// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "datmo_fusion/common/object.h"

namespace datmo {

/// Probability of each ObjectClass, in the order of its values; they sum to 1. All 0, as in a track
/// of a source that reports no classes: nothing is known, as with equal ones.
using ClassProbabilities = std::array<double, kObjectClasses>;

/// What independent beliefs say together (Bayes), in any order: all started from equal
/// probabilities, so that their product is the posterior. As in ClassBelief no class becomes
/// impossible. Of those that contradict all that the others say nothing is left: all are equally
/// likely, as of none. One alone stays as it is.
ClassProbabilities jointBelief(const std::vector<ClassProbabilities>& beliefs);

/// How likely something that was measured is of each of the three road users, relative to each
/// other; each at least 0, and one above it.
struct RoadUserLikelihoods {
  double pedestrian;
  double cyclist;
  double vehicle;
};

/// The same of each class, relative to the mean of the three: of anything else it is as likely.
ClassProbabilities ofEachClass(const RoadUserLikelihoods& likelihoods);

/// What was said, and what was measured besides (Bayes): a factor for each class, or its inverse to
/// take it out again. The result sums to 1.
ClassProbabilities posterior(ClassProbabilities said, const ClassProbabilities& factors);
ClassProbabilities withoutFactors(ClassProbabilities weighed, const ClassProbabilities& factors);

/// Whether one class is likelier than by chance, by more than the doubt that ClassBelief keeps.
bool tellsAnything(const ClassProbabilities& belief);

/// What an object is, from all class reports so far (Bayes). Before anything was
/// said all classes are equally likely.
///
/// No class ever becomes impossible: a classifier that errs once tends to err on the same object
/// again, so what it says is not independent, and the belief must be able to change.
class ClassBelief {
 public:
  ClassBelief();

  /// One more observation: the class, with a probability of 0 to 1 that it is right; the other
  /// classes share the rest equally. An unknown class carries no information, nor does a
  /// probability that is not above chance (one in kObjectClasses).
  void update(ObjectClass observed, double probability);

  const ClassProbabilities& probabilities() const { return probabilities_; }
  double probability(ObjectClass object_class) const;

  /// Of equally likely ones the first in the order of ObjectClass: kUnknown before anything was
  /// said.
  ObjectClass mostLikely() const;

  /// Whether an object of this class may be the same: not where both are known and differ (thesis
  /// 3.3.4). Known of a belief: likelier than all other classes together.
  bool compatible(ObjectClass object_class) const;

 private:
  ClassProbabilities probabilities_;
};

}  // namespace datmo
