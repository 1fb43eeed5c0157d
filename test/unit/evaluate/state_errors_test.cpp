// SPDX-License-Identifier: BSD-3-Clause
#include "evaluate/state_errors.h"

#include <cmath>

#include "made_frames.h"
#include <gtest/gtest.h>

#include "datmo_fusion/common/angle.h"

namespace datmo::evaluation::state_errors_test {
namespace {

/// Errors of one pair that differs in heading only.
StateErrors errorsOfHeadings(double truth_heading, double track_heading) {
  TrueState truth = truthAt(1, 0.0);
  TrackState track = trackAt(1, 0.0);
  truth.box.center = Pose2(0.0, 0.0, truth_heading);
  track.box.center = Pose2(0.0, 0.0, track_heading);
  StateErrorSum sum;
  sum.add(truth, track);
  return sum.result();
}

TEST(StateErrors, NoneWithoutSamples) {
  const StateErrors errors = StateErrorSum().result();
  EXPECT_EQ(errors.samples, 0U);
  EXPECT_FALSE(errors.position || errors.velocity || errors.heading || errors.heading_modulo_pi);
}

TEST(StateErrors, RootMeanSquareOfTheVectors) {
  // Position: 5 m and 0 m; velocity: (0, -2) m/s and (4, 0) m/s.
  StateErrorSum sum;
  TrueState truth = truthAt(1, 1.0, 1.0);
  truth.velocity = Point2(10.0, 0.0);
  TrackState far = trackAt(1, 4.0, 5.0);
  far.velocity = Point2(10.0, -2.0);
  TrackState on_it = trackAt(1, 1.0, 1.0);
  on_it.velocity = Point2(14.0, 0.0);
  sum.add(truth, far);
  sum.add(truth, on_it);
  EXPECT_EQ(sum.result().samples, 2U);
  EXPECT_DOUBLE_EQ(sum.result().position.value(), std::sqrt(25.0 / 2.0));
  EXPECT_DOUBLE_EQ(sum.result().velocity.value(), std::sqrt((4.0 + 16.0) / 2.0));
  EXPECT_DOUBLE_EQ(sum.result().heading.value(), 0.0);
}

TEST(StateErrors, FrontAndRearExchanged) {
  const StateErrors errors = errorsOfHeadings(degrees(10.0), degrees(-165.0));
  EXPECT_NEAR(errors.heading.value(), degrees(175.0), 1e-12);
  EXPECT_NEAR(errors.heading_modulo_pi.value(), degrees(5.0), 1e-12);
}

TEST(StateErrors, TheShortWayOverPi) {
  const StateErrors errors = errorsOfHeadings(degrees(179.0), degrees(-178.0));
  EXPECT_NEAR(errors.heading.value(), degrees(3.0), 1e-12);
  EXPECT_NEAR(errors.heading_modulo_pi.value(), degrees(3.0), 1e-12);
}

TEST(StateErrors, OfRequiredAndMatchedObjectsAlone) {
  const Frames frames = FrameMaker()
                            .add({truthAt(1, 0.0), optionalAt(2, 10.0), truthAt(3, 20.0)},
                                 {trackAt(1, 0.0, 1.0), trackAt(2, 11.5), trackAt(3, 30.0)})
                            .frames();
  const StateErrors errors = scoreStateErrors(frames, matchFrames(frames, MatchOptions()));
  EXPECT_EQ(errors.samples, 1U);
  EXPECT_DOUBLE_EQ(errors.position.value(), 1.0);
}

}  // namespace
}  // namespace datmo::evaluation::state_errors_test
