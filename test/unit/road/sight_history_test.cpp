#include "datmo_fusion/road/sight_history.h"

#include <limits>

#include "sight_samples.h"
#include <gtest/gtest.h>

namespace datmo {
namespace {

using samples::scanOf;

class SightHistoryTest : public testing::Test {
 protected:
  /// At something that runs across the x axis.
  Sight lookAt(const Point2& place) const { return history_.look(0, {place, Point2::UnitY()}); }

  SightHistory history_{SightHistoryOptions{}};
};

TEST_F(SightHistoryTest, SeesAHitNearItsEnd) {
  history_.add(scanOf({{20.0, 0.0}}, 0.0));
  EXPECT_EQ(lookAt({20.0, 0.0}), Sight::kHit);
  EXPECT_EQ(lookAt({20.3, 0.0}), Sight::kHit)
      << "the tolerance is 0.4 m, and 0.1 m for the bearing";
  EXPECT_EQ(lookAt({20.6, 0.0}), Sight::kNothing);
}

TEST_F(SightHistoryTest, AFlatBeamMeetsAKerbSomeWayAlong) {
  // A kerb along y = 2; the beam of 6 degrees meets it at 19.03 m ahead.
  const Point2 met(2.0 / std::tan(kPi / 30.0), 2.0);
  history_.add(scanOf({met}, 0.0));
  const Point2 beside(19.6, 2.0);  // the same beam lights it
  EXPECT_EQ(history_.look(0, {beside, Point2::UnitX()}), Sight::kHit);
  EXPECT_EQ(history_.look(0, {beside, Point2::UnitY()}), Sight::kNothing) << "behind the hit";
}

TEST_F(SightHistoryTest, ThePlaceBesideTheKerbIsFreeIfTheKerbIsSeen) {
  const Point2 met(2.0 / std::tan(kPi / 30.0), 2.0);
  history_.add(scanOf({met}, 0.0));
  EXPECT_EQ(history_.look(0, {{19.0, 1.8}, Point2::UnitX()}), Sight::kNothing)
      << "no beam lights it";
  const Point2 in_beam(1.8 / std::tan(kPi / 30.0), 1.8);
  EXPECT_EQ(history_.look(0, {in_beam, Point2::UnitX()}), Sight::kFree);
}

TEST_F(SightHistoryTest, AFlatBeamMayMissTheLineByMore) {
  // 0.005 rad at 19.1 m and 6 degrees to the line are 0.91 m along the beam.
  const double bearing = kPi / 30.0;
  const double crossing = 2.0 / std::sin(bearing);
  const SightPlace place{{crossing * std::cos(bearing), 2.0}, Point2::UnitX()};
  const auto endsAt = [&](double range, double seconds) {
    history_.add(scanOf({{range * std::cos(bearing), range * std::sin(bearing)}}, seconds));
    return history_.look(0, place);
  };
  EXPECT_EQ(endsAt(crossing + 1.2, 0.0), Sight::kHit);
  EXPECT_EQ(endsAt(crossing + 1.5, 1.0), Sight::kFree);
  EXPECT_EQ(endsAt(crossing - 1.5, 2.0), Sight::kNothing);
}

TEST_F(SightHistoryTest, ABeamAlongALineTellsNothingOfIt) {
  history_.add(scanOf({{20.0, 0.0}}, 0.0));
  EXPECT_EQ(history_.look(0, {{20.0, 0.0}, Point2::UnitX()}), Sight::kNothing);
}

TEST(SightHistorySparseTest, ABeamThatLeadsAwayFromTheLineTellsNothingOfIt) {
  // Beams half a radian apart: the one straight ahead lights a place that lies 0.2 rad beside it,
  // but meets the line there only behind the scanner, at -3.4 m.
  SightHistoryOptions options;
  options.lit_share = 1.0;
  SightHistory history(options);
  SplitScan scan = scanOf({}, 0.0);
  scan.field.beams = 3;
  scan.field.beam_spacing = 0.5;
  scan.field.first_bearing = -0.5;
  history.add(scan);
  const Point2 place(10.0 * std::cos(0.2), 10.0 * std::sin(0.2));
  EXPECT_EQ(history.look(0, {place, {std::cos(0.15), std::sin(0.15)}}), Sight::kNothing);
  EXPECT_EQ(history.look(0, {place, Point2::UnitY()}), Sight::kFree);
}

TEST_F(SightHistoryTest, SeesFreeWhatABeamWentThrough) {
  history_.add(scanOf({{20.0, 0.0}}, 0.0));
  EXPECT_EQ(lookAt({10.0, 0.0}), Sight::kFree);
  EXPECT_EQ(lookAt({19.0, 0.0}), Sight::kFree);
}

TEST_F(SightHistoryTest, SeesNothingBehindAHit) {
  history_.add(scanOf({{20.0, 0.0}}, 0.0));
  EXPECT_EQ(lookAt({21.0, 0.0}), Sight::kNothing);
}

TEST_F(SightHistoryTest, ABeamWithoutReturnIsFreeAsFarAsTheFieldSays) {
  history_.add(scanOf({}, 0.0));
  EXPECT_EQ(lookAt({39.3, 0.0}), Sight::kFree);
  EXPECT_EQ(lookAt({39.7, 0.0}), Sight::kNothing);
}

TEST_F(SightHistoryTest, SeesNothingBetweenTheBeams) {
  history_.add(scanOf({}, 0.0));
  const double halfway = kPi / 180.0;
  EXPECT_EQ(lookAt({30.0 * std::cos(halfway), 30.0 * std::sin(halfway)}), Sight::kNothing);
}

TEST_F(SightHistoryTest, SeesNothingOutsideOfTheField) {
  history_.add(scanOf({}, 0.0));
  EXPECT_EQ(lookAt({-10.0, 0.0}), Sight::kNothing);
  EXPECT_EQ(lookAt({0.5, 10.0}), Sight::kNothing) << "the field ends at 80 degrees";
}

TEST_F(SightHistoryTest, SeesNothingBeyondAllNumbers) {
  history_.add(scanOf({}, 0.0));
  EXPECT_EQ(lookAt({std::numeric_limits<double>::quiet_NaN(), 0.0}), Sight::kNothing);
  EXPECT_EQ(lookAt({std::numeric_limits<double>::infinity(), 0.0}), Sight::kNothing);
}

TEST_F(SightHistoryTest, ABlindBeamSaysNothing) {
  SplitScan scan = scanOf({}, 0.0);
  scan.blind_beams = {40};
  history_.add(scan);
  EXPECT_EQ(lookAt({10.0, 0.0}), Sight::kNothing);
}

TEST_F(SightHistoryTest, PlacesStandInTheMap) {
  history_.add(scanOf({{20.0, 5.0}}, 0.0, Pose2(10.0, 5.0, 0.0)));
  EXPECT_EQ(lookAt({20.0, 5.0}), Sight::kHit);
  EXPECT_EQ(lookAt({15.0, 5.0}), Sight::kFree);
  EXPECT_EQ(lookAt({5.0, 5.0}), Sight::kNothing) << "behind the vehicle";
}

TEST_F(SightHistoryTest, AFullTurnIsSeenAllRound) {
  SplitScan scan = scanOf({}, 0.0);
  scan.field.beams = 180;
  scan.field.first_bearing = -kPi;
  history_.add(scan);
  EXPECT_EQ(lookAt({10.0, 0.0}), Sight::kFree);
  EXPECT_EQ(lookAt({-10.0, 0.0}), Sight::kFree);
  EXPECT_EQ(history_.look(0, {{0.0, 10.0}, Point2::UnitX()}), Sight::kFree);
  EXPECT_EQ(history_.look(0, {{0.0, -10.0}, Point2::UnitX()}), Sight::kFree);
}

TEST_F(SightHistoryTest, AScanOfAnUnknownFieldSaysNothing) {
  SplitScan scan = scanOf({{20.0, 0.0}}, 0.0);
  scan.field = {};
  history_.add(scan);
  EXPECT_EQ(lookAt({20.0, 0.0}), Sight::kNothing);
  EXPECT_EQ(lookAt({10.0, 0.0}), Sight::kNothing);
}

TEST_F(SightHistoryTest, ForgetsWhatIsOld) {
  for (int i = 0; i <= 50; ++i) {
    history_.add(scanOf({}, 0.1 * i));
  }
  EXPECT_EQ(history_.size(), 41U) << "4 s";
  EXPECT_NEAR(history_.age(10), 1.0, 1e-9);
  history_.clear();
  EXPECT_EQ(history_.size(), 0U);
}

TEST(SightHistoryMemoryTest, HoldsNoMoreScansThanItMay) {
  SightHistoryOptions options;
  options.most_scans = 5;
  SightHistory history(options);
  for (int i = 0; i < 20; ++i) {
    history.add(scanOf({}, 0.01 * i));
  }
  EXPECT_EQ(history.size(), 5U);
}

}  // namespace
}  // namespace datmo
