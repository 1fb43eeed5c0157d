// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/tracking/multiple_hypotheses.h"

#include <cmath>

#include "association_scene.h"
#include <gtest/gtest.h>

#include "datmo_fusion/common/class_belief.h"
#include "datmo_fusion/tracking/nearest_neighbor.h"

namespace datmo::multiple_hypotheses_test {
namespace {

/// Probability of a target of the best hypothesis; 0: none of this number.
double probabilityOf(const TargetSet& targets, std::uint64_t number) {
  for (const BestTarget& best : targets.best()) {
    if (best.target->number() == number) {
      return best.probability;
    }
  }
  return 0.0;
}

class MultipleHypothesesTest : public testing::Test {
 protected:
  MultipleHypotheses targets() const {
    SplitMergeOptions apart;
    apart.split_probability = 0.0;
    apart.merge_probability = 0.0;
    return {TargetOptions(), association_, hypotheses_, apart};
  }

  /// One target at the origin, then two objects that may both be it; the second one is nearer.
  MultipleHypotheses inDoubt() {
    MultipleHypotheses result = targets();
    see(result, source_, objectsAlong({0.0}));
    see(result, source_, objectsAlong({-0.5, 0.45}));
    return result;
  }

  /// Weight of "seen as this object" versus "missed" for a target that was seen once.
  double weightOf(const Object& object) const {
    const Target target = predictedAt(0.0, 0.0);
    const double seen =
        target.existenceProbability(TargetOptions()) * source_.detectionProbability();
    return seen / (1.0 - seen) *
           std::exp(target.filter().logLikelihood(target.measurementOf(object))) /
           source_.density();
  }

  ScanSource source_;
  AssociationOptions association_;
  HypothesisOptions hypotheses_;
};

TEST_F(MultipleHypothesesTest, WeightsTheHypothesesOfAnAmbiguousScan) {
  const MultipleHypotheses result = inDoubt();
  const double first = weightOf(objectAt(-0.5, 0.0));
  const double second = weightOf(objectAt(0.45, 0.0));
  ASSERT_GT(second, first);
  ASSERT_EQ(result.best().size(), 2U);
  EXPECT_EQ(measurementIndex(result, 1), 1U);
  EXPECT_DOUBLE_EQ(probabilityOf(result, 1), 1.0) << "it exists in all of them";
  // The other object is from a new target, if it is not from the first one: missed, or seen as the
  // second.
  EXPECT_NEAR(probabilityOf(result, 2), (1.0 + second) / (1.0 + first + second), 1e-12);
}

TEST_F(MultipleHypothesesTest, AMissIsEvidenceAgainstMoreTargets) {
  MultipleHypotheses result = inDoubt();
  see(result, source_, {});
  const TargetOptions options;
  const double detection = source_.detectionProbability();
  const auto missed = [&](const Target& target) {
    return 1.0 - detection * target.existenceProbability(options);
  };
  const auto missedIfSeenAt = [&](double x) {
    Target target = predictedAt(0.0, 0.0);
    target.update({objectAt(x, 0.0), {0}, std::log(ScanIntakeOptions().new_density)}, 0, detection,
                  options);
    return missed(target);
  };
  Target not_seen = predictedAt(0.0, 0.0);
  not_seen.miss(detection, options);
  const double born = missed(targetAt(0.0, 0.0));
  const double first = weightOf(objectAt(-0.5, 0.0)) * missedIfSeenAt(-0.5) * born;
  const double second = weightOf(objectAt(0.45, 0.0)) * missedIfSeenAt(0.45) * born;
  const double neither = missed(not_seen) * born * born;
  EXPECT_NEAR(probabilityOf(result, 2), (second + neither) / (first + second + neither), 1e-9);
}

TEST_F(MultipleHypothesesTest, UnlikelyHypothesesAreDropped) {
  hypotheses_.min_ratio = 0.9;
  EXPECT_EQ(probabilityOf(inDoubt(), 2), 1.0);
}

TEST_F(MultipleHypothesesTest, ADecisionIsFinalAfterTheScanHistory) {
  for (const int history : {0, 1, 2, 5, 8}) {
    hypotheses_.scan_history = history;
    MultipleHypotheses result = inDoubt();
    for (int later = 0; later < history; ++later) {
      EXPECT_LT(probabilityOf(result, 2), 1.0) << later << " scans later of " << history;
      see(result, source_, {});
    }
    EXPECT_EQ(probabilityOf(result, 2), 1.0) << history;
  }
}

/// A target moves straight on for a while; then it turns off, and another object appears beside it,
/// for one scan, nearer to its predicted position.
template <typename Targets>
void turnOffBesideAnother(Targets& targets, ScanSource& source, bool another) {
  for (int i = 0; i < 20; ++i) {
    see(targets, source, {objectAt(0.5 * i, 0.0)});
  }
  targets.change(1, [](Target& target) {
    target.setId(3);
    target.confirm(1, true);
  });
  std::vector<Object> objects{objectAt(10.0, 0.35)};
  if (another) {
    objects.push_back(objectAt(10.0, -0.3));
  }
  see(targets, source, objects);
  for (int i = 1; i < 4; ++i) {
    see(targets, source, {objectAt(10.0 + 0.5 * i, 0.35 + 0.35 * i)});
  }
}

TEST_F(MultipleHypothesesTest, LaterScansCorrectTheNearestNeighborsErrors) {
  MultipleHypotheses alone = targets();
  turnOffBesideAnother(alone, source_, false);
  MultipleHypotheses result = targets();
  turnOffBesideAnother(result, source_, true);
  const Target& expected = *alone.best().front().target;
  const Target& found = *result.best().front().target;
  ASSERT_EQ(found.number(), 1U);
  EXPECT_TRUE(found.filter().estimate().mean.isApprox(expected.filter().estimate().mean, 1e-12))
      << "as if the other object had never been there";
  EXPECT_EQ(found.id(), 3U);

  NearestNeighborTargets nearest{TargetOptions(), AssociationOptions()};
  turnOffBesideAnother(nearest, source_, true);
  EXPECT_FALSE(nearest.best().front().target->filter().estimate().mean.isApprox(
      expected.filter().estimate().mean, 1e-3));
}

TEST_F(MultipleHypothesesTest, ClearlyDifferentClassesAreNeverTheSameTarget) {
  const auto of = [](ObjectClass object_class) {
    Object object = objectAt(0.0, 0.0);
    object.class_probabilities = reportedClass(object_class, 0.99);
    return object;
  };
  MultipleHypotheses result = targets();
  see(result, source_, {of(ObjectClass::kCyclist)});
  see(result, source_, {of(ObjectClass::kVehicle)});
  EXPECT_EQ(measurementIndex(result, 1), kUnseen);
  EXPECT_EQ(measurementIndex(result, 2), 0U);
  EXPECT_EQ(probabilityOf(result, 2), 1.0);
  see(result, source_, {of(ObjectClass::kUnknown)});
  EXPECT_EQ(result.best().size(), 2U);
}

/// This many targets in a row, spaced half as far as they may have moved; then as many objects
/// between them: more explanations than could ever be evaluated.
void crowd(MultipleHypotheses& targets, ScanSource& source, int size) {
  std::vector<double> first;
  std::vector<double> second;
  for (int i = 0; i < size; ++i) {
    first.push_back(0.4 * i);
    second.push_back(0.4 * i + 0.2);
  }
  see(targets, source, objectsAlong(first));
  see(targets, source, objectsAlong(second));
  see(targets, source, objectsAlong(first));
}

TEST_F(MultipleHypothesesTest, ACrowdIsCutToTheBestHypothesesAndCounted) {
  MultipleHypotheses result = targets();
  crowd(result, source_, 25);
  EXPECT_GT(result.counts().cut_hypotheses, 0U);
  EXPECT_EQ(result.counts().best_only_steps, 0U);
  EXPECT_GE(result.best().size(), 25U);
}

TEST_F(MultipleHypothesesTest, FullTreesEndTheSearch) {
  hypotheses_.max_leaves = 1;
  hypotheses_.min_ratio = 0.0;
  MultipleHypotheses result = targets();
  crowd(result, source_, 25);
  EXPECT_GT(result.counts().cut_hypotheses, 0U);
  for (const BestTarget& best : result.best()) {
    EXPECT_EQ(best.probability, 1.0) << "one leaf each leaves one hypothesis";
  }
}

TEST_F(MultipleHypothesesTest, OfATooLargeClusterTheBestHypothesisIsKept) {
  hypotheses_.max_joint_targets = 10;
  MultipleHypotheses result = targets();
  crowd(result, source_, 25);
  EXPECT_GT(result.counts().cut_hypotheses, 0U);
  for (const BestTarget& best : result.best()) {
    EXPECT_EQ(best.probability, 1.0);
  }
}

TEST_F(MultipleHypothesesTest, OutOfTimeItDecidesLikeTheNearestNeighbor) {
  double now = 0.0;
  const StepClock clock = [&now] { return now += 1.0; };
  MultipleHypotheses result = targets();
  NearestNeighborTargets nearest{TargetOptions(), AssociationOptions()};
  for (const std::vector<double>& scan :
       std::vector<std::vector<double>>{{0.0, 9.0}, {-0.5, 0.45, 9.5}, {0.2, 0.9, 10.0}}) {
    see(result, source_, objectsAlong(scan), StepBudget(clock, 0.5));
    see(nearest, source_, objectsAlong(scan));
    ASSERT_EQ(result.best().size(), nearest.best().size());
    for (std::size_t i = 0; i < result.best().size(); ++i) {
      EXPECT_EQ(result.best()[i].target->measurementIndex(),
                nearest.best()[i].target->measurementIndex());
      EXPECT_EQ(result.best()[i].probability, 1.0);
    }
  }
  EXPECT_EQ(result.counts().best_only_steps, 2U) << "once for each step with targets";
  see(result, source_, {}, StepBudget(clock, 1e9));
  EXPECT_EQ(result.counts().best_only_steps, 2U);
}

TEST_F(MultipleHypothesesTest, AFullListRefusesNewObjectsAndCountsEachOnce) {
  association_.max_targets = 2;
  MultipleHypotheses result = targets();
  see(result, source_, objectsAlong({0.0, 10.0, 20.0}));
  EXPECT_EQ(result.best().size(), 2U);
  EXPECT_EQ(result.counts().refused_births, 1U);
  see(result, source_, objectsAlong({-0.5, 0.45, 10.0}));
  EXPECT_EQ(result.best().size(), 2U);
  EXPECT_GE(result.counts().refused_births, 2U);
  EXPECT_LE(result.counts().refused_births, 4U) << "three objects, in whatever hypotheses";
}

TEST_F(MultipleHypothesesTest, RemovesAndForgetsButNumbersContinue) {
  MultipleHypotheses result = inDoubt();
  result.removeIf([](const Target& target) { return target.number() == 1; });
  EXPECT_EQ(probabilityOf(result, 1), 0.0);
  EXPECT_EQ(result.best().size(), 1U) << "of what remains either object started the target";
  result.clear();
  EXPECT_TRUE(result.best().empty());
  see(result, source_, objectsAlong({0.0}));
  EXPECT_EQ(result.best().front().target->number(), 4U);
}

}  // namespace
}  // namespace datmo::multiple_hypotheses_test
