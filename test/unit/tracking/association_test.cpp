// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/tracking/association.h"

#include <cmath>

#include "association_scene.h"
#include <gtest/gtest.h>

#include "datmo_fusion/common/class_belief.h"
#include "datmo_fusion/common/random.h"

namespace datmo::association_test {
namespace {

constexpr double kExistence = 0.6;

class AssociationTest : public testing::Test {
 protected:
  std::vector<std::size_t> candidatesOf(const Target& target, const std::vector<Object>& objects) {
    std::vector<std::size_t> result;
    const AssociationScan scan = source_.scan(objects);
    for (const Candidate& candidate : scoresOf(target, scan, kExistence, options_).candidates) {
      result.push_back(candidate.observation);
    }
    return result;
  }

  ScanSource source_;
  AssociationOptions options_;
};

TEST_F(AssociationTest, ScoresAreThoseOfBlackmanWithAnExistence) {
  const Target target = predictedAt(0.0, 0.0);
  const AssociationScan scan = source_.scan({objectAt(0.3, 0.1)});
  const TargetScores scores = scoresOf(target, scan, kExistence, options_);
  const double seen = kExistence * source_.detectionProbability();
  EXPECT_DOUBLE_EQ(scores.detection_probability, source_.detectionProbability());
  EXPECT_NEAR(scores.missed, std::log(1.0 - seen), 1e-12);
  ASSERT_EQ(scores.candidates.size(), 1U);
  const PositionMeasurement measured = target.measurementOf(scan.observations[0].object);
  const double likelihood = std::exp(target.filter().logLikelihood(measured));
  EXPECT_NEAR(scores.candidates[0].score,
              std::log(seen * likelihood / ((1.0 - seen) * source_.density())), 1e-9);
}

TEST_F(AssociationTest, MoreCertainToExistScoresHigher) {
  const Target target = predictedAt(0.0, 0.0);
  const AssociationScan scan = source_.scan({objectAt(0.3, 0.1)});
  const TargetScores unsure = scoresOf(target, scan, 0.2, options_);
  const TargetScores sure = scoresOf(target, scan, 0.99, options_);
  EXPECT_GT(sure.candidates.at(0).score, unsure.candidates.at(0).score);
  EXPECT_LT(sure.missed, unsure.missed);
}

TEST_F(AssociationTest, OnlyObjectsWithinTheGateByAscendingX) {
  const Target target = predictedAt(0.0, 0.0);
  EXPECT_EQ(candidatesOf(target, objectsAlong({50.0, 0.4, -50.0, -0.3})),
            (std::vector<std::size_t>{1, 2}));
  EXPECT_TRUE(candidatesOf(target, {}).empty());
}

TEST_F(AssociationTest, TheGateIsAMahalanobisDistance) {
  const Target target = predictedAt(0.0, 0.0);
  const Object object = objectAt(1.5, 0.0);
  const double distance2 =
      innovationOf(target.filter().estimate(), target.measurementOf(object)).squaredDistance();
  options_.gate = 1.01 * distance2;
  EXPECT_EQ(candidatesOf(target, {object}).size(), 1U);
  options_.gate = 0.99 * distance2;
  EXPECT_TRUE(candidatesOf(target, {object}).empty());
}

TEST_F(AssociationTest, ThePregateLosesNothingWithinTheGate) {
  // All objects that pass the gate by themselves are found among many, small and large ones.
  const Target target = predictedAt(0.0, 0.0);
  std::vector<Object> objects;
  for (int i = -60; i <= 60; ++i) {
    objects.push_back(objectAt(0.1 * i, 0.03 * i));
    objects.back().box.length = i % 3 == 0 ? 8.0 : 0.5;
  }
  options_.max_candidates = 1000;
  std::size_t expected = 0;
  for (const Object& object : objects) {
    const Innovation innovation =
        innovationOf(target.filter().estimate(), target.measurementOf(object));
    expected += innovation.squaredDistance() <= options_.gate ? 1 : 0;
  }
  EXPECT_GT(expected, 10U);
  EXPECT_LT(expected, objects.size());
  EXPECT_EQ(candidatesOf(target, objects).size(), expected);
}

TEST_F(AssociationTest, ThePregateLosesNothingWhateverSidesAreVisible) {
  Random random(1);
  const auto anyObject = [&random] {
    Object object = objectAt(random.uniform(-8.0, 8.0), random.uniform(-8.0, 8.0));
    object.box = {Pose2(object.box.center.position(), random.uniform(-kPi, kPi)),
                  random.uniform(0.0, 9.0), random.uniform(0.0, 3.0)};
    for (double& side : object.side_variance) {
      side = random.uniform(0.0, 1.0) < 0.5 ? kHiddenSide : random.uniform(0.0, 0.5);
    }
    object.delay = random.uniform(0.0, 1.0) < 0.3 ? random.uniform(-0.3, 0.3) : 0.0;
    return object;
  };
  options_.max_candidates = 1000;
  std::size_t within = 0;
  std::size_t late = 0;
  for (int i = 0; i < 300; ++i) {
    const TargetOptions options;
    Object born = anyObject();
    born.velocity = MeasuredVelocity{
        {random.uniform(-9.0, 9.0), random.uniform(-9.0, 9.0)}, Eigen::Matrix2d::Identity(), 0.0};
    Target target(born, 0, 1, options);
    for (int seen = i % 3; seen > 0; --seen) {  // from other sides, too
      target.predict(0.1, immSteps(options.filter, 0.1), options);
      target.update({anyObject(), {0}}, 0, 0.9, options);
    }
    target.predict(0.1, immSteps(options.filter, 0.1), options);
    const CenterGate gate = target.gateOf(options_.gate);
    for (int k = 0; k < 30; ++k) {
      const Object object = anyObject();
      const double distance =
          (object.box.center.position() - target.box().center.position()).norm();
      const Innovation innovation =
          innovationOf(target.filter().estimate(), target.measurementOf(object));
      if (innovation.squaredDistance() <= options_.gate) {
        ++within;
        late += object.delay == 0.0 ? 0 : 1;
        EXPECT_LE(distance, gate.reach(CenterBound(object)));
      }
    }
  }
  EXPECT_GT(within, 300U);
  EXPECT_GT(late, 50U);
}

TEST_F(AssociationTest, ThePregateLosesNoLateObject) {
  const TargetOptions options;
  Object born = objectAt(0.0, 0.0);
  born.velocity = MeasuredVelocity{{25.0, 0.0}, 0.01 * Eigen::Matrix2d::Identity(), 0.0};
  Target target(born, 0, 1, options);
  target.predict(0.1, immSteps(options.filter, 0.1), options);
  Object late = objectAt(target.box().center.position().x() - 10.0, 0.0);
  late.delay = -0.4;  // seen where the target was then
  EXPECT_EQ(candidatesOf(target, {late}).size(), 1U);
}

TEST_F(AssociationTest, OfManyTheNearestAreCandidates) {
  options_.max_candidates = 2;
  EXPECT_EQ(candidatesOf(predictedAt(0.0, 0.0), objectsAlong({-0.9, -0.2, 0.1, 0.6})),
            (std::vector<std::size_t>{1, 2}));
}

Object ofClass(ObjectClass object_class, double probability) {
  Object object = objectAt(0.0, 0.0);
  object.class_probabilities = reportedClass(object_class, probability);
  return object;
}

TEST_F(AssociationTest, ClearlyDifferentClassesAreNeverAssociated) {
  const auto of = [](ObjectClass object_class) { return ofClass(object_class, 0.99); };
  const Target cyclist(of(ObjectClass::kCyclist), 0, 1, TargetOptions());
  EXPECT_TRUE(candidatesOf(cyclist, {of(ObjectClass::kVehicle)}).empty());
  EXPECT_EQ(candidatesOf(cyclist, {of(ObjectClass::kCyclist)}).size(), 1U);
  EXPECT_EQ(candidatesOf(cyclist, {of(ObjectClass::kUnknown)}).size(), 1U);
  const Target unknown(of(ObjectClass::kUnknown), 0, 1, TargetOptions());
  EXPECT_EQ(candidatesOf(unknown, {of(ObjectClass::kVehicle)}).size(), 1U);
}

TEST_F(AssociationTest, PossiblyDifferentClassesCountByProbability) {
  const Target cyclist(ofClass(ObjectClass::kCyclist, 0.8), 0, 1, TargetOptions());
  const auto scoreOf = [&](ObjectClass object_class, double probability) {
    const AssociationScan scan = source_.scan({ofClass(object_class, probability)});
    const TargetScores scores = scoresOf(cyclist, scan, kExistence, options_);
    EXPECT_EQ(scores.candidates.size(), 1U);
    return scores.candidates.at(0).score;
  };
  const double unknown = scoreOf(ObjectClass::kUnknown, 0.0);
  const double pedestrian = scoreOf(ObjectClass::kPedestrian, 0.8);
  EXPECT_LT(scoreOf(ObjectClass::kPedestrian, 0.9), pedestrian);
  EXPECT_LT(pedestrian, scoreOf(ObjectClass::kPedestrian, 0.5));
  // The target is a pedestrian with probability 0.05 (ClassBelief's doubt: 0.0575), the object with
  // 0.8.
  const double same = 0.0575 * 0.8 + (1.0 - 0.0575) * 0.2 / 4.0;
  EXPECT_NEAR(pedestrian - unknown, std::log(same / 0.2), 1e-9);
  EXPECT_EQ(scoreOf(ObjectClass::kCyclist, 0.8), unknown) << "others are cyclists too";
}

TEST_F(AssociationTest, OnlyObjectsByThemselvesAreFoundOthersAreAdded) {
  const Target target = predictedAt(0.0, 0.0);
  AssociationScan scan = source_.scan(objectsAlong({-0.2, 0.2}));
  scan.observations.push_back({objectAt(0.0, 0.0), {0, 1}, 0.0, ObservedTarget::kKnown});
  TargetScores scores = scoresOf(target, scan, kExistence, options_);
  ASSERT_EQ(scores.candidates.size(), 2U);
  addCandidate(target, scan, 2, options_, scores);
  ASSERT_EQ(scores.candidates.size(), 3U);
  EXPECT_EQ(scores.candidates[2].observation, 2U);
  scan.observations.push_back({objectAt(30.0, 0.0), {0, 1}, 0.0, ObservedTarget::kKnown});
  addCandidate(target, scan, 3, options_, scores);
  EXPECT_EQ(scores.candidates.size(), 3U) << "outside of the gate";
}

}  // namespace
}  // namespace datmo::association_test
