#include "datmo_fusion/road/sight_history.h"

#include "sight_samples.h"
#include <gtest/gtest.h>

namespace datmo {
namespace {

using samples::scanOf;

class SightHistoryTest : public testing::Test {
 protected:
  Sight lookAt(const Point2& place) const { return history_.look(0, place); }

  SightHistory history_{SightHistoryOptions{}};
};

TEST_F(SightHistoryTest, SeesAHitNearItsEnd) {
  history_.add(scanOf({{20.0, 0.0}}, 0.0));
  EXPECT_EQ(lookAt({20.0, 0.0}), Sight::kHit);
  EXPECT_EQ(lookAt({20.5, 0.0}), Sight::kHit);
  EXPECT_EQ(lookAt({20.0, 0.55}), Sight::kHit) << "the tolerance is 0.6 m in all directions";
  EXPECT_NE(lookAt({20.0, 0.65}), Sight::kHit);
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
  EXPECT_EQ(lookAt({39.0, 0.0}), Sight::kFree);
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
  EXPECT_EQ(lookAt({0.0, 10.0}), Sight::kFree);
  EXPECT_EQ(lookAt({0.0, -10.0}), Sight::kFree);
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
