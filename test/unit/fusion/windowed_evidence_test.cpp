// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/fusion/track/windowed_evidence.h"

#include <gtest/gtest.h>

namespace datmo::windowed_evidence_test {
namespace {

constexpr double kRounding = 1e-9;

Stamp at(double seconds) { return Stamp::fromSeconds(100.0 + seconds); }

WindowedEvidenceOptions options() {
  WindowedEvidenceOptions options;
  options.window = 2.0;
  options.correlation_time = 0.5;
  options.look_limit = 10.0;
  return options;
}

/// The evidence of equal observations at this rate (Hz), for this long.
double sumAtRate(double rate, double seconds, double each) {
  WindowedEvidence evidence;
  for (int i = 0; i <= static_cast<int>(seconds * rate); ++i) {
    evidence.look(at(i / rate), each, options());
  }
  return evidence.sum();
}

TEST(WindowedEvidenceTest, TheFirstObservationCountsInFullAndLaterOnesByTheInterval) {
  WindowedEvidence evidence;
  evidence.look(at(0.0), 4.0, options());
  EXPECT_NEAR(evidence.sum(), 4.0, kRounding);
  evidence.look(at(0.1), 5.0, options());  // a fifth of the correlation time
  EXPECT_NEAR(evidence.sum(), 5.0, kRounding);
  evidence.look(at(1.1), -3.0, options());  // longer than it: in full, not twice
  EXPECT_NEAR(evidence.sum(), 2.0, kRounding);
  evidence.look(at(1.1), 7.0, options());  // no time, no new information
  EXPECT_NEAR(evidence.sum(), 2.0, kRounding);
}

TEST(WindowedEvidenceTest, DoesNotDependOnTheRateOfObservations) {
  EXPECT_NEAR(sumAtRate(10.0, 1.5, 2.0), 2.0 + 1.5 / 0.5 * 2.0, kRounding);
  EXPECT_NEAR(sumAtRate(10.0, 1.5, 2.0), sumAtRate(40.0, 1.5, 2.0), kRounding);
}

TEST(WindowedEvidenceTest, OneObservationIsLimitedInBothDirections) {
  WindowedEvidence evidence;
  evidence.look(at(0.0), 1000.0, options());
  EXPECT_NEAR(evidence.sum(), 10.0, kRounding);
  evidence.look(at(0.5), -1e300, options());
  EXPECT_NEAR(evidence.sum(), 0.0, kRounding);
}

TEST(WindowedEvidenceTest, ForgetsEvidenceOlderThanTheWindow) {
  WindowedEvidence evidence;
  evidence.look(at(0.0), 3.0, options());
  evidence.look(at(1.0), 2.0, options());
  evidence.forgetBefore(at(2.0), options());
  EXPECT_NEAR(evidence.sum(), 5.0, kRounding);
  evidence.forgetBefore(at(2.5), options());
  EXPECT_NEAR(evidence.sum(), 2.0, kRounding);
  evidence.forgetBefore(at(3.5), options());
  EXPECT_TRUE(evidence.empty());
  EXPECT_EQ(evidence.sum(), 0.0);
}

}  // namespace
}  // namespace datmo::windowed_evidence_test
