// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/stage/risk_stage.h"

#include <cmath>
#include <limits>

#include "labeled_scan_samples.h"
#include "monitor_counts.h"
#include "risk_samples.h"
#include <gtest/gtest.h>

#include "datmo_fusion/ros/convert/message_conversion.h"

namespace datmo::risk_stage_test {
namespace {

class RiskStageTest : public testing::Test {
 protected:
  void scanAt(double seconds) {
    stage_.handleLabeledScan(toMessage(samples::scanBetweenWalls(seconds), "base_link", "map"));
  }

  void odometryAt(double seconds, double speed = samples::kHostSpeed) {
    stage_.handleOdometry(samples::odometry(samples::kStart + seconds, speed));
  }

  /// A stationary car this far ahead of base_link, between the walls.
  static TrackArray carAhead(double seconds, double ahead) {
    return samples::standingCar(seconds, samples::kHostSpeed * seconds + ahead);
  }

  /// The risks of one step with all inputs.
  RiskArrayPtr step(double seconds, double ahead) {
    odometryAt(seconds);
    scanAt(seconds);
    return stage_.handleTracks(carAhead(seconds, ahead));
  }

  static RiskMessage riskOf(const RiskArray& risks, std::uint32_t id) {
    for (const RiskMessage& risk : risks.risks) {
      if (risk.id == id) {
        return risk;
      }
    }
    ADD_FAILURE() << "no risk of " << id;
    return {};
  }

  StageMonitor monitor_{"risk"};
  RiskStage stage_{RiskStageOptions(), monitor_};
};

TEST_F(RiskStageTest, ACarAheadIsARisk) {
  const auto risks = step(0.0, 17.0);
  ASSERT_NE(risks, nullptr);
  EXPECT_EQ(risks->header.frame_id, "map");
  EXPECT_EQ(risks->header.stamp, ros::Time(samples::kStart));
  const RiskMessage risk = riskOf(*risks, 7);
  // 17 m less 3.7 m to the bumper and half of 4 m, at 5 m/s.
  EXPECT_NEAR(risk.median_ttc, 2.26F, 0.25F);
  EXPECT_GT(risk.contact_probability[3], 0.8F);
  EXPECT_EQ(risk.side, RiskMessage::SIDE_FRONT);
  EXPECT_EQ(risk.classification, static_cast<std::uint8_t>(ObjectClass::kVehicle));
  EXPECT_EQ(monitor_.processedCount(), 1U);
}

TEST_F(RiskStageTest, WarnsAndSaysWhy) {
  step(0.0, 12.0);
  const auto risks = step(0.2, 11.0);
  ASSERT_NE(risks, nullptr);
  EXPECT_GE(risks->level, RiskArray::LEVEL_WARNING);
  EXPECT_EQ(risks->cause, 7U);
  EXPECT_NE(risks->reason.find("vehicle 7"), std::string::npos) << risks->reason;
}

// A newly visible object is a road user as likely as a wall, until it is a track or in the map.
TEST_F(RiskStageTest, UnmappedPointsCauseNoWarning) {
  const auto levelWith = [&](PointState state, double start) {
    RiskArrayPtr risks;
    for (const double seconds : {start, start + 0.2, start + 0.4}) {
      LabeledScan scan = samples::scanBetweenWalls(seconds);
      for (const double y : {-0.4, 0.0, 0.4}) {
        scan.points.push_back({{10.0, y}, 10.0, 0.0, 0, state});
      }
      odometryAt(seconds);
      stage_.handleLabeledScan(toMessage(scan, "base_link", "map"));
      TrackArray none = carAhead(seconds, 17.0);
      none.tracks.clear();
      risks = stage_.handleTracks(none);
    }
    return risks->level;
  };
  EXPECT_EQ(levelWith(PointState::kUnknown, 0.0), RiskArray::LEVEL_NONE);
  EXPECT_GE(levelWith(PointState::kStatic, 1.0), RiskArray::LEVEL_WARNING);
}

TEST_F(RiskStageTest, WithoutOdometryTheMotionIsThatOfThePoses) {
  scanAt(0.0);
  scanAt(0.1);
  const auto risks = stage_.handleTracks(carAhead(0.1, 17.0));
  ASSERT_NE(risks, nullptr);
  EXPECT_NEAR(riskOf(*risks, 7).median_ttc, 2.26F, 0.25F);
  EXPECT_EQ(samples::warnings(monitor_, "no_odometry"), 1U);
}

TEST_F(RiskStageTest, WithoutPoseOrMotionThereIsNoRisk) {
  EXPECT_EQ(stage_.handleTracks(carAhead(0.0, 17.0)), nullptr);
  EXPECT_EQ(samples::drops(monitor_, "no_pose"), 1U);
  scanAt(0.1);
  EXPECT_EQ(stage_.handleTracks(carAhead(0.1, 17.0)), nullptr);
  EXPECT_EQ(samples::drops(monitor_, "no_motion"), 1U);
}

TEST_F(RiskStageTest, InvalidTracksAreReported) {
  odometryAt(0.0);
  scanAt(0.0);
  TrackArray tracks = carAhead(0.0, 17.0);
  tracks.tracks[0].covariance[0] = std::numeric_limits<double>::quiet_NaN();
  const auto risks = stage_.handleTracks(tracks);
  ASSERT_NE(risks, nullptr);
  EXPECT_EQ(risks->risks.size(), 1U) << "what stands alone";
  EXPECT_EQ(samples::warnings(monitor_, "bad_track"), 1U);
}

TEST_F(RiskStageTest, TracksNotSeenForLongAreCounted) {
  odometryAt(0.0);
  scanAt(0.0);
  TrackArray tracks = carAhead(0.0, 17.0);
  tracks.tracks[0].since_update = ros::Duration(1.5);
  ASSERT_NE(stage_.handleTracks(tracks), nullptr);
  EXPECT_EQ(monitor_.figures().at("objects not seen for max_silence"), 1.0);
}

TEST_F(RiskStageTest, ManyTracksAreLimitedAndReported) {
  odometryAt(0.0);
  scanAt(0.0);
  TrackArray tracks = carAhead(0.0, 17.0);
  for (std::uint32_t id = 8; id < 507; ++id) {
    tracks.tracks.push_back(tracks.tracks.front());
    tracks.tracks.back().id = id;
  }
  const auto risks = stage_.handleTracks(tracks);
  ASSERT_NE(risks, nullptr);
  EXPECT_EQ(risks->risks.size(), 65U);
  EXPECT_EQ(samples::warnings(monitor_, "many_tracks"), 1U);
}

TEST_F(RiskStageTest, AnotherFrameIsRefused) {
  odometryAt(0.0);
  scanAt(0.0);
  TrackArray tracks = carAhead(0.0, 17.0);
  tracks.header.frame_id = "world";
  EXPECT_EQ(stage_.handleTracks(tracks), nullptr);
  EXPECT_EQ(samples::drops(monitor_, "wrong_frame"), 1U);
}

TEST_F(RiskStageTest, AClockJumpBackStartsOver) {
  const auto first = step(0.0, 17.0);
  step(20.0, 17.0);
  const auto again = step(0.0, 17.0);
  ASSERT_NE(first, nullptr);
  ASSERT_NE(again, nullptr);
  EXPECT_GE(samples::warnings(monitor_, "clock_restart"), 1U);
  EXPECT_EQ(*first, *again);
}

}  // namespace
}  // namespace datmo::risk_stage_test
