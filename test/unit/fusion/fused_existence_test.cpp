// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/fusion/object/fused_existence.h"

#include <gtest/gtest.h>

namespace datmo::fused_existence_test {
namespace {

constexpr double kRounding = 1e-12;

ExistenceReport seen(double existence) { return {true, existence, 0.0, 0.8, 0.1}; }

ExistenceReport notSeen(double looked) { return {false, 0.0, looked, 0.8, 0.1}; }

TEST(FusedExistenceTest, OfOneSourceIsUnchanged) {
  EXPECT_NEAR(fusedExistence({seen(0.7)}), 0.7, kRounding);
  EXPECT_NEAR(fusedExistence({seen(0.7), notSeen(0.0)}), 0.7, kRounding);
}

TEST(FusedExistenceTest, ImpossibleObjectsAreNotDetected) {
  EXPECT_EQ(fusedExistence({}), 0.0);
  EXPECT_EQ(fusedExistence({notSeen(0.5), notSeen(0.9)}), 0.0);
}

TEST(FusedExistenceTest, AMissInViewIsEvidenceAgainstIt) {
  // Odds of 1, times 1 - 0.8 * 0.5 = 0.6.
  EXPECT_NEAR(fusedExistence({seen(0.5), notSeen(0.5)}), 0.6 / 1.6, kRounding);
  EXPECT_NEAR(fusedExistence({notSeen(0.5), seen(0.5)}), 0.6 / 1.6, kRounding);
}

TEST(FusedExistenceTest, AnotherDetectionIsEvidenceForIt) {
  // Odds of 1 by the surer one, times 0.8 / 0.1.
  EXPECT_NEAR(fusedExistence({seen(0.5), seen(0.3)}), 8.0 / 9.0, kRounding);
  EXPECT_NEAR(fusedExistence({seen(0.3), seen(0.5)}), 8.0 / 9.0, kRounding);
}

TEST(FusedExistenceTest, ASourceThatAgreesWithAnythingIsUninformative) {
  ExistenceReport credulous = seen(0.2);
  credulous.false_agreement_probability = 1.0;
  EXPECT_NEAR(fusedExistence({seen(0.5), credulous}), 0.5, kRounding);
}

TEST(FusedExistenceTest, CertaintyCanBeRevised) {
  const double sure = fusedExistence({seen(1.0)});
  EXPECT_LT(sure, 1.0);
  EXPECT_LT(fusedExistence({seen(1.0), notSeen(1.0)}), sure);
}

}  // namespace
}  // namespace datmo::fused_existence_test
