// SPDX-License-Identifier: BSD-3-Clause
// The end of a beam along a wall moves with the scanner, and is no object.
#include <cmath>

#include "beam_evidence_scene.h"

namespace datmo::grazing_test {
namespace {

using samples::scanOf;

/// The end of a beam that moves along a wall with the scanner, along x, as the scanner passes it.
class GrazingTest : public samples::BeamEvidenceScene {
 protected:
  /// Scans of an echo at these positions relative to the scanner, 0.1 s apart.
  double grazingShare(const std::vector<Point2>& positions, double speed = 8.0) {
    for (std::size_t i = 0; i < positions.size(); ++i) {
      const double seconds = 0.1 * static_cast<double>(i);
      const double x = speed * seconds;  // of the scanner
      const Point2 position = positions[i] + Point2(x, 0.0);
      history_.add(scanOf({position}, seconds, Pose2(x, 0.0, 0.0)));
      see(seconds, {position});
    }
    const double end = 0.1 * static_cast<double>(positions.size() - 1);
    return evidence(end, {{Pose2(positions.back() + Point2(speed * end, 0.0), 0.0), 0.5, 0.5},
                          {0.0, 0.0},
                          {speed, 0.0},
                          0.04})
        .grazing_share;
  }
  double grazingShareAt(const Point2& position) {
    return grazingShare({position, position, position});
  }
};

TEST_F(GrazingTest, AnEchoBesideThePathThatKeepsItsBeamMayBeTheEndOfOneAlongAWall) {
  EXPECT_NEAR(grazingShareAt({20.0, 5.0}), options_.grazing_share, 1e-9);
}

TEST_F(GrazingTest, NoWallIsInTheVehiclesOwnPath) {
  EXPECT_LT(grazingShareAt({20.0, 0.5}), 0.01 * options_.grazing_share);
}

TEST_F(GrazingTest, AtTheEdgeOfThePathAWallIsHalfAsLikely) {
  options_.free_path = 1.4;  // m: a beam faces there
  EXPECT_NEAR(grazingShareAt({20.0, 1.4}), 0.5 * options_.grazing_share, 1e-9);
}

TEST_F(GrazingTest, FarAheadThePathIsLessCertain) {
  const double near = grazingShareAt({20.0, 1.4});
  history_.clear();
  seen_.clear();
  EXPECT_GT(grazingShareAt({40.0, 1.4}), 1.5 * near);
}

TEST_F(GrazingTest, WhileCreepingThePathIsUnknown) {
  const std::vector<Point2> ahead(5, {20.0, 0.0});
  EXPECT_GT(grazingShare(ahead, 0.05), 0.4 * options_.grazing_share);
}

TEST_F(GrazingTest, InABendAWallMayBeStraightAhead) {
  // 8 m/s on a radius of 50 m to the left, whose outer wall is hit by the beam straight ahead.
  constexpr double kRadius = 50.0;
  constexpr double kYawRate = 8.0 / kRadius;
  Pose2 scanner;
  for (int i = 0; i <= 15; ++i) {
    const double seconds = 0.1 * i;
    const double turn = kYawRate * seconds;
    scanner = Pose2(kRadius * std::sin(turn), kRadius * (1.0 - std::cos(turn)), turn);
    const Point2 position = scanner * Point2(20.0, 0.0);
    history_.add(scanOf({position}, seconds, scanner));
    see(seconds, {position});
  }
  const Point2 along = scanner.rotate(Point2(8.0, 0.0));
  const MovingBody end_of_beam{
      {scanner * Pose2(20.0, 0.0, 0.0), 0.5, 0.5}, {0.0, 0.0}, along, 0.04};
  EXPECT_GT(evidence(1.5, end_of_beam).grazing_share, 0.2 * options_.grazing_share);
}

TEST_F(GrazingTest, PositionsWithoutBeamEndsAreNone) {
  see(0.0, {{20.0, 5.0}});
  for (const double seconds : {0.0, 0.1}) {
    history_.add(scanOf({}, seconds, Pose2(seconds, 0.0, 0.0)));
  }
  const MovingBody keeps_its_bearing{
      {Pose2(20.1, 5.0, 0.0), 0.5, 0.5}, {0.0, 0.0}, {1.0, 0.0}, 0.04};
  EXPECT_EQ(evidence(0.1, keeps_its_bearing).grazing_share, 0.0);
}

TEST_F(GrazingTest, AnEchoThatMovesFromBeamToBeamIsNone) {
  EXPECT_EQ(grazingShare({{20.0, 5.0}, {20.0, 5.7}, {20.0, 5.7}}), 0.0);
}

}  // namespace
}  // namespace datmo::grazing_test
