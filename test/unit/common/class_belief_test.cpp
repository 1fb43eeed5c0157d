// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/common/class_belief.h"

#include <numeric>

#include <gtest/gtest.h>

namespace datmo::class_belief_test {
namespace {

constexpr double kTolerance = 1e-12;
constexpr ObjectClass kAllClasses[] = {ObjectClass::kUnknown, ObjectClass::kPedestrian,
                                       ObjectClass::kCyclist, ObjectClass::kVehicle,
                                       ObjectClass::kPole};

TEST(ClassBelief, IsUniformInitially) {
  const ClassBelief belief;
  for (const ObjectClass object_class : kAllClasses) {
    EXPECT_DOUBLE_EQ(belief.probability(object_class), 0.2);
    EXPECT_TRUE(belief.compatible(object_class));
  }
  EXPECT_EQ(belief.mostLikely(), ObjectClass::kUnknown);
}

TEST(ClassBelief, OfOneObservationIsItsProbabilityWithSomeDoubt) {
  ClassBelief belief;
  belief.update(reportedClass(ObjectClass::kVehicle, 0.8));
  // 0.95 of 0.8 and of the four others' 0.05, and 0.01 for each class.
  EXPECT_NEAR(belief.probability(ObjectClass::kVehicle), 0.77, kTolerance);
  EXPECT_NEAR(belief.probability(ObjectClass::kPole), 0.0575, kTolerance);
  EXPECT_EQ(belief.mostLikely(), ObjectClass::kVehicle);
}

TEST(ClassBelief, GrowsWithEveryObservation) {
  ClassBelief belief;
  belief.update(reportedClass(ObjectClass::kCyclist, 0.5));
  const double once = belief.probability(ObjectClass::kCyclist);
  belief.update(reportedClass(ObjectClass::kCyclist, 0.5));
  EXPECT_GT(belief.probability(ObjectClass::kCyclist), once);
}

TEST(ClassBelief, LearnsNothingFromAnUnknownClassOrByChance) {
  ClassBelief belief;
  belief.update(reportedClass(ObjectClass::kPole, 0.7));
  const ClassProbabilities before = belief.probabilities();
  belief.update(reportedClass(ObjectClass::kUnknown, 1.0));
  belief.update(reportedClass(ObjectClass::kPedestrian, 0.2));
  belief.update(reportedClass(ObjectClass::kPedestrian, 0.0));
  EXPECT_EQ(belief.probabilities(), before);
}

TEST(ClassBelief, LearnsNothingFromSomethingElse) {
  ClassBelief belief;
  belief.update(reportedClass(ObjectClass::kPole, 0.7));
  const ClassProbabilities before = belief.probabilities();
  belief.update({0.5, 0.1, 0.3, 0.1, 0.0});
  EXPECT_EQ(belief.probabilities(), before);
}

TEST(ClassBelief, DistinguishesClassesOtherThanTheMostLikelyOne) {
  ClassBelief belief;
  for (int i = 0; i < 2; ++i) {
    belief.update({0.0, 0.48, 0.02, 0.5, 0.0});
  }
  EXPECT_GT(belief.probability(ObjectClass::kPedestrian),
            10.0 * belief.probability(ObjectClass::kCyclist));
}

void expectNear(const ClassProbabilities& one, const ClassProbabilities& other) {
  for (std::size_t i = 0; i < kObjectClasses; ++i) {
    EXPECT_NEAR(one[i], other[i], kTolerance) << i;
  }
}

TEST(ClassLikelihoods, OfAReportAllOthersShareTheRest) {
  const ClassProbabilities reported = reportedClass(ObjectClass::kCyclist, 0.6);
  EXPECT_EQ(mostLikelyClass(reported), ObjectClass::kCyclist);
  expectNear(classLikelihoods(reported).value(), {0.1, 0.1, 0.6, 0.1, 0.1});
}

TEST(ClassLikelihoods, OfAnUnknownClassIsTheMeanOfTheLessLikelyOnes) {
  // 0.125, 0.5, 0.125 and 0, and the mean of the three smaller ones, 1/12: 5/6 in all.
  expectNear(classLikelihoods({0.25, 0.125, 0.5, 0.125, 0.0}).value(),
             {1.0 / 10.0, 3.0 / 20.0, 3.0 / 5.0, 3.0 / 20.0, 0.0});
}

TEST(ClassLikelihoods, ThereAreNoneWithoutEvidenceForAClass) {
  EXPECT_FALSE(classLikelihoods({}));
  EXPECT_FALSE(classLikelihoods(ClassBelief().probabilities()));
  EXPECT_FALSE(classLikelihoods(reportedClass(ObjectClass::kCyclist, 0.2)));
  EXPECT_FALSE(classLikelihoods(reportedClass(ObjectClass::kUnknown, 1.0)));
  EXPECT_FALSE(classLikelihoods({0.5, 0.1, 0.3, 0.1, 0.0}));  // something else
}

TEST(ClassBelief, StaysAProbabilityAndCanTurn) {
  ClassBelief belief;
  for (int i = 0; i < 1000; ++i) {
    belief.update(reportedClass(ObjectClass::kPedestrian, 1.0));
  }
  for (const double value : belief.probabilities()) {
    EXPECT_GE(value, 0.01 - kTolerance);
  }
  const ClassProbabilities& all = belief.probabilities();
  EXPECT_NEAR(std::accumulate(all.begin(), all.end(), 0.0), 1.0, kTolerance);
  for (int i = 0; i < 3; ++i) {
    belief.update(reportedClass(ObjectClass::kVehicle, 0.9));
  }
  EXPECT_EQ(belief.mostLikely(), ObjectClass::kVehicle);
}

TEST(ClassBelief, OfAKnownClassRefusesTheOtherKnownOnes) {
  ClassBelief belief;
  belief.update(reportedClass(ObjectClass::kVehicle, 0.9));
  EXPECT_TRUE(belief.compatible(ObjectClass::kVehicle));
  EXPECT_TRUE(belief.compatible(ObjectClass::kUnknown));
  EXPECT_FALSE(belief.compatible(ObjectClass::kPedestrian));
  EXPECT_FALSE(belief.compatible(ObjectClass::kCyclist));
  EXPECT_FALSE(belief.compatible(ObjectClass::kPole));
}

TEST(ClassBelief, ThatIsNotCertainRefusesNone) {
  ClassBelief belief;
  belief.update(reportedClass(ObjectClass::kVehicle, 0.4));
  EXPECT_EQ(belief.mostLikely(), ObjectClass::kVehicle);
  EXPECT_TRUE(belief.compatible(ObjectClass::kPedestrian));
}

TEST(ClassBelief, IsInformativeIfOneClassExceedsChanceByMoreThanTheDoubt) {
  EXPECT_FALSE(isInformative(ClassBelief().probabilities()));
  EXPECT_FALSE(isInformative({0.19, 0.19, 0.19, 0.24, 0.19}));
  EXPECT_TRUE(isInformative({0.18, 0.18, 0.18, 0.28, 0.18}));
}

TEST(ClassBelief, LikelihoodsWeightRoadUsersAndLeaveTheOthers) {
  const ClassProbabilities factors = ofEachClass({0.5, 1.0, 0.3});
  EXPECT_NEAR(factors[1], 0.5 / 0.6, kTolerance);
  EXPECT_NEAR(factors[2], 1.0 / 0.6, kTolerance);
  EXPECT_NEAR(factors[3], 0.3 / 0.6, kTolerance);
  const ClassProbabilities said = {0.1, 0.2, 0.3, 0.3, 0.1};
  const ClassProbabilities weighed = posterior(said, factors);
  const double total = 0.1 + 0.2 * 0.5 / 0.6 + 0.3 / 0.6 + 0.3 * 0.3 / 0.6 + 0.1;
  EXPECT_NEAR(weighed[0], 0.1 / total, kTolerance);
  EXPECT_NEAR(weighed[2], 0.3 / 0.6 / total, kTolerance);
  EXPECT_NEAR(std::accumulate(weighed.begin(), weighed.end(), 0.0), 1.0, kTolerance);
  const ClassProbabilities back = withoutFactors(weighed, factors);
  for (std::size_t i = 0; i < said.size(); ++i) {
    EXPECT_NEAR(back[i], said[i], kTolerance);
  }
}

TEST(ClassBelief, TwoBeliefsAreJoinedByBayes) {
  const ClassProbabilities a = {0.1, 0.1, 0.1, 0.6, 0.1};
  const ClassProbabilities b = {0.1, 0.1, 0.4, 0.3, 0.1};
  // Products 0.01, 0.01, 0.04, 0.18, 0.01, of 0.25; 0.95 of them, and 0.01 for each class.
  const ClassProbabilities both = jointBelief({a, b});
  EXPECT_NEAR(both[3], 0.694, kTolerance);
  EXPECT_NEAR(both[2], 0.162, kTolerance);
  EXPECT_EQ(both, jointBelief({b, a}));
  // Contradictions leave the class unknown.
  for (const double value : jointBelief({ClassProbabilities{1.0}, ClassProbabilities{0.0, 1.0}})) {
    EXPECT_DOUBLE_EQ(value, 0.2);
  }
}

TEST(ClassBelief, SeveralBeliefsAreJoinedInAnyOrderWithTheDoubtOfOneObservation) {
  const ClassProbabilities a = {0.1, 0.1, 0.1, 0.6, 0.1};
  const ClassProbabilities b = {0.1, 0.1, 0.4, 0.3, 0.1};
  const ClassProbabilities c = {0.1, 0.1, 0.5, 0.2, 0.1};
  // Products 1, 1, 20, 36, 1 of 59.
  for (const auto& all : {std::vector<ClassProbabilities>{a, b, c}, {c, a, b}, {b, c, a}}) {
    const ClassProbabilities joint = jointBelief(all);
    EXPECT_NEAR(joint[3], 0.95 * 36.0 / 59.0 + 0.01, kTolerance);
    EXPECT_NEAR(joint[0], 0.95 / 59.0 + 0.01, kTolerance);
  }
  EXPECT_EQ(jointBelief({a}), a);
  EXPECT_EQ(jointBelief({}), ClassBelief().probabilities());
}

TEST(ClassBelief, OfASourceWithoutClassesIsUninformed) {
  const ClassProbabilities none{};
  const ClassProbabilities equal = ClassBelief().probabilities();
  const ClassProbabilities said = {0.1, 0.1, 0.1, 0.6, 0.1};
  const ClassProbabilities factors = ofEachClass({0.5, 1.0, 0.3});
  EXPECT_EQ(jointBelief({none}), equal);
  EXPECT_EQ(jointBelief({said, none}), jointBelief({said, equal}));
  EXPECT_EQ(posterior(none, factors), posterior(equal, factors));
  EXPECT_EQ(withoutFactors(none, factors), withoutFactors(equal, factors));
}

}  // namespace
}  // namespace datmo::class_belief_test
