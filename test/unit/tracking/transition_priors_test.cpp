// SPDX-License-Identifier: BSD-3-Clause
#include "sojourn_time.h"
#include <gtest/gtest.h>

#include "datmo_fusion/tracking/transition_model.h"

namespace datmo::transition_priors_test {
namespace {

using samples::sojourn;

constexpr double kPeriod = 0.1;  // s
constexpr int kStanding = static_cast<int>(MotionMode::kStanding);

class Priors : public testing::Test {
 protected:
  Priors() { options_.adaptive = true; }

  /// A target that switches between modes 0 and 1 all the time.
  TransitionModel restlessTarget(const TransitionPriors& priors, ObjectClass object_class) const {
    TransitionModel target = *priors.modelOf(object_class);
    for (int i = 0; i < 100; ++i) {
      target.predict(kPeriod);
      target.update(ModeVector::Unit(i % 2), ModeVector::Unit(1 - i % 2));
    }
    return target;
  }

  TransitionOptions options_;
};

TEST_F(Priors, StartFromTheSojournTimes) {
  const JumpCounts counts = TransitionPriors(options_).of(ObjectClass::kCyclist);
  EXPECT_NEAR(sojourn(counts, 0), options_.straight_sojourn, 1e-12);
  EXPECT_NEAR(sojourn(counts, kStanding), options_.standing_sojourn, 1e-12);
}

TEST_F(Priors, GiveNoModelWithoutAdaptation) {
  options_.adaptive = false;
  EXPECT_FALSE(TransitionPriors(options_).modelOf(ObjectClass::kVehicle).has_value());
}

TEST_F(Priors, AClassLearnsFromItsTargetsAndNoOtherDoes) {
  TransitionPriors priors(options_);
  priors.learn(ObjectClass::kPedestrian, restlessTarget(priors, ObjectClass::kPedestrian));
  const double prior = options_.straight_sojourn;
  EXPECT_LT(sojourn(priors.of(ObjectClass::kPedestrian), 0), 0.5 * prior);
  EXPECT_LT(sojourn(priors.of(ObjectClass::kUnknown), 0), 0.5 * prior);
  EXPECT_NEAR(sojourn(priors.of(ObjectClass::kVehicle), 0), prior, 1e-12);
}

TEST_F(Priors, TheirWeightIsBounded) {
  TransitionPriors priors(options_);
  for (int i = 0; i < 200; ++i) {
    priors.learn(ObjectClass::kVehicle, restlessTarget(priors, ObjectClass::kVehicle));
    EXPECT_LE(priors.of(ObjectClass::kVehicle).exposure.maxCoeff(),
              options_.learning.prior_exposure * (1.0 + 1e-9));
  }
  // However much was learned, a class can change its transition probabilities.
  const double learned_sojourn = sojourn(priors.of(ObjectClass::kVehicle), 0);
  for (int i = 0; i < 100; ++i) {
    TransitionModel calm = *priors.modelOf(ObjectClass::kVehicle);
    for (int j = 0; j < 100; ++j) {
      calm.predict(kPeriod);
      calm.update(ModeVector::Unit(0), ModeVector::Unit(0));
    }
    priors.learn(ObjectClass::kVehicle, calm);
  }
  EXPECT_GT(sojourn(priors.of(ObjectClass::kVehicle), 0), 3.0 * learned_sojourn);
}

TEST_F(Priors, WithoutStandingItIsNeverLearned) {
  options_.standing = false;
  TransitionPriors priors(options_);
  priors.learn(ObjectClass::kVehicle, restlessTarget(priors, ObjectClass::kVehicle));
  const JumpCounts counts = priors.of(ObjectClass::kVehicle);
  EXPECT_TRUE(counts.jumps.col(kStanding).isZero());
  EXPECT_TRUE(counts.jumps.row(kStanding).isZero());
}

}  // namespace
}  // namespace datmo::transition_priors_test
