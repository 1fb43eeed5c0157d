// SPDX-License-Identifier: BSD-3-Clause
// A receiver, poses, and another station: what is accepted, and what is dropped and counted.
#include "datmo_fusion/ros/stage/v2x_stage.h"

#include <cmath>
#include <functional>
#include <limits>

#include "message_samples.h"
#include "monitor_counts.h"
#include <gtest/gtest.h>

#include "datmo_fusion/ros/convert/earth_conversion.h"
#include "datmo_fusion/ros/convert/message_conversion.h"
#include "datmo_fusion/ros/stage/earth_frame_stage.h"
#include "datmo_fusion/ros/stage/output_check.h"

namespace datmo::v2x_stage_test {
namespace {

constexpr double kSpeed = 10.0;  // m/s
constexpr double kPeriod = 0.1;  // s
constexpr int kSteps = 100;      // of the drive
constexpr std::uint32_t kPole = 3;
const Pose2 kMap(0.0, 0.0, 0.6);  // in the plane whose datum is where the drive starts

Stamp stampAt(int step) { return Stamp::fromSeconds(100.0 + kPeriod * step); }

class V2xStageTest : public testing::Test {
 protected:
  V2xStageTest() {
    tf2_msgs::TFMessage mount;
    mount.transforms = {toTransform(Pose2(1.0, 0.0, 0.0), stampAt(0), "base_link", "antenna")};
    transforms_.addStatic(mount);
  }

  /// Sends the vehicle's pose at a step, and the receiver's fix at it, if it has one. `jump`: m, of
  /// the fixes, in the map.
  void drive(int from, int to, bool has_fix = true, const Point2& jump = Point2::Zero()) {
    for (int step = from; step < to; ++step) {
      const Pose2 base(kSpeed * kPeriod * step, 0.0, 0.0);
      sensor_msgs::NavSatFix fix;
      fix.header.stamp = toTime(stampAt(step));
      fix.header.frame_id = "antenna";
      const Point2 antenna = base * Point2(1.0, 0.0) + jump;
      const GeodeticPosition position = plane_.toGeodetic(kMap * antenna);
      fix.latitude = toDegrees(position.latitude);
      fix.longitude = toDegrees(position.longitude);
      fix.altitude = position.altitude;
      fix.position_covariance = {0.01, 0.0, 0.0, 0.0, 0.01, 0.0, 0.0, 0.0, 0.01};
      fix.position_covariance_type = sensor_msgs::NavSatFix::COVARIANCE_TYPE_DIAGONAL_KNOWN;
      if (has_fix) {
        earth_.handleFix(fix);
      }
      geometry_msgs::PoseWithCovarianceStamped pose;
      pose.header.stamp = fix.header.stamp;
      pose.header.frame_id = "map";
      pose.pose = toMessage(PoseWithCovariance{base, 1e-4 * Eigen::Matrix3d::Identity()});
      stage_.handlePose(pose);
      if (const EarthFrameMessagePtr frame = earth_.handlePose(pose)) {
        stage_.handleFrame(*frame);
      }
    }
  }

  /// A pedestrian at a point in the map.
  StationTracksMessage listAt(int step, const Point2& in_map) const {
    StationTrackList list;
    list.stamp = stampAt(step);
    list.station = kPole;
    StationTrack track;
    track.id = 5;
    track.position = kMap * in_map;
    track.covariance = 0.04 * Eigen::Matrix4d::Identity();
    track.length = track.width = 0.5;
    track.class_probabilities[static_cast<std::size_t>(ObjectClass::kPedestrian)] = 1.0;
    list.tracks.push_back(track);
    return toMessage(list, plane_);
  }

  LocalPlane plane_{{degrees(45.19), degrees(5.72), 212.0}};
  StageMonitor earth_monitor_{"earth_frame"};
  StageMonitor monitor_{"v2x"};
  TransformBuffer transforms_{1.0};
  EarthFrameStage earth_{EarthFrameStageOptions(), transforms_, earth_monitor_};
  V2xStage stage_{V2xStageOptions(), monitor_};
};

TEST_F(V2xStageTest, WithoutReceiverNothingIsPublishedAndThatIsReported) {
  EXPECT_EQ(stage_.handleStation(listAt(0, {20.0, 5.0}), stampAt(0)), nullptr);
  EXPECT_EQ(samples::drops(monitor_, "no_earth_frame"), 1U);
  EXPECT_EQ(monitor_.health(), HealthLevel::kDegraded);
}

TEST_F(V2xStageTest, TrackOfAnotherStationIsWhereItIsInTheMap) {
  drive(0, kSteps);
  const Point2 there(kSpeed * kPeriod * kSteps + 20.0, 5.0);
  const TrackArrayPtr tracks = stage_.handleStation(listAt(kSteps, there), stampAt(kSteps));
  ASSERT_TRUE(tracks);
  ASSERT_EQ(tracks->tracks.size(), 1U);
  EXPECT_EQ(tracks->header.frame_id, "map");
  EXPECT_NEAR(tracks->tracks[0].pose.position.x, there.x(), 0.1);
  EXPECT_NEAR(tracks->tracks[0].pose.position.y, there.y(), 0.1);
}

TEST_F(V2xStageTest, TheMapsDriftWithoutReceiverIsInTheCovariance) {
  drive(0, kSteps);
  const int end = kSteps + 40;  // 4 s
  const auto variance = [&](int step) {
    const TrackArrayPtr tracks =
        stage_.handleStation(listAt(step, {kSpeed * kPeriod * step + 20.0, 5.0}), stampAt(step));
    return tracks ? tracks->tracks.at(0).covariance[0] : 0.0;
  };
  const double before = variance(kSteps);
  drive(kSteps, end, false);
  const double drift = EarthFrameOptions().map_drift;
  EXPECT_GT(variance(end), before + 0.9 * drift * drift * kSpeed * kPeriod * (end - kSteps));
  EXPECT_TRUE(monitor_.drops().empty());
  drive(end, end + 15, false);
  EXPECT_EQ(variance(end + 15), 0.0) << "older than max_frame_age";
  EXPECT_EQ(samples::drops(monitor_, "no_earth_frame"), 1U);
}

TEST_F(V2xStageTest, UnusableListsAreDroppedByReason) {
  drive(0, kSteps);
  const StationTracksMessage list = listAt(kSteps, {120.0, 5.0});
  ASSERT_TRUE(stage_.handleStation(list, stampAt(kSteps)));
  EXPECT_EQ(stage_.handleStation(list, stampAt(kSteps)), nullptr);
  EXPECT_EQ(samples::drops(monitor_, "repeated_list"), 1U);
  EXPECT_EQ(stage_.handleStation(list, stampAt(kSteps + 50)), nullptr);
  EXPECT_EQ(samples::drops(monitor_, "old_list"), 1U);
  EXPECT_EQ(stage_.handleStation(listAt(kSteps + 10, {120.0, 5.0}), stampAt(kSteps)), nullptr);
  EXPECT_EQ(samples::drops(monitor_, "future_list"), 1U);
  StationTracksMessage ours = listAt(kSteps + 1, {120.0, 5.0});
  ours.station = 1;
  EXPECT_EQ(stage_.handleStation(ours, stampAt(kSteps + 1)), nullptr);
  EXPECT_EQ(samples::drops(monitor_, "own_number"), 1U);
}

TEST_F(V2xStageTest, ATrackFasterThanAnyVehicleIsLeftOutAndReported) {
  drive(0, kSteps);
  StationTracksMessage list = listAt(kSteps, {120.0, 5.0});
  list.tracks.push_back(list.tracks[0]);
  list.tracks[1].id = 6;
  list.tracks[1].velocity_east = 200.0 / 3.6;
  const TrackArrayPtr tracks = stage_.handleStation(list, stampAt(kSteps));
  ASSERT_TRUE(tracks);
  ASSERT_EQ(tracks->tracks.size(), 1U);
  EXPECT_NEAR(tracks->tracks[0].velocity.x, 0.0, 1e-6) << "the pedestrian at the same place";
  EXPECT_EQ(samples::warnings(monitor_, "fast_track"), 1U);
  EXPECT_EQ(monitor_.figures().at("tracks left out: too fast"), 1.0);
  EXPECT_EQ(monitor_.figures().at("tracks left out: jumped"), 0.0);
  EXPECT_TRUE(monitor_.drops().empty()) << "the rest of the list is used";
}

TEST_F(V2xStageTest, ATrackThatJumpsIsLeftOutUntilItHasProvenItself) {
  drive(0, kSteps);
  const auto tracksAt = [this](int step, const Point2& in_map) {
    const TrackArrayPtr tracks = stage_.handleStation(listAt(step, in_map), stampAt(step));
    return tracks ? static_cast<int>(tracks->tracks.size()) : -1;
  };
  ASSERT_EQ(tracksAt(kSteps, {120.0, 5.0}), 1);
  const int probation = StationTrackOptions().probation;
  for (int message = 1; message <= probation; ++message) {
    EXPECT_EQ(tracksAt(kSteps + message, {150.0, 5.0}), 0) << message;
    EXPECT_EQ(samples::warnings(monitor_, "jumped_track"), static_cast<std::uint64_t>(message));
  }
  EXPECT_EQ(tracksAt(kSteps + probation + 1, {150.0, 5.0}), 1);
  EXPECT_EQ(samples::warnings(monitor_, "jumped_track"), static_cast<std::uint64_t>(probation));
  EXPECT_EQ(monitor_.figures().at("tracks left out: jumped"), probation);
  EXPECT_EQ(monitor_.figures().at("tracks left out: too fast"), 0.0);
  EXPECT_TRUE(monitor_.drops().empty());
}

TEST_F(V2xStageTest, AJumpOfTheReceiverIsRejectedUntilItLasts) {
  const Point2 jump(200.0, 0.0);
  constexpr int kShort = 4;  // fixes
  const int restart_after = EarthFrameOptions().restart_after;
  drive(0, kSteps);
  EXPECT_EQ(samples::warnings(earth_monitor_, "far_position"), 0U);
  drive(kSteps, kSteps + kShort, true, jump);
  EXPECT_EQ(samples::warnings(earth_monitor_, "far_position"), std::uint64_t{kShort});
  EXPECT_EQ(earth_monitor_.health(), HealthLevel::kOk);
  const int last = kSteps + kShort - 1;
  const TrackArrayPtr tracks = stage_.handleStation(listAt(last, {140.0, 5.0}), stampAt(last));
  ASSERT_TRUE(tracks);
  ASSERT_EQ(tracks->tracks.size(), 1U);
  EXPECT_NEAR(tracks->tracks[0].pose.position.x, 140.0, 0.2) << "the map is where it was";
  drive(last + 1, last + 2);
  EXPECT_EQ(samples::warnings(earth_monitor_, "far_position"), std::uint64_t{kShort});
  drive(last + 2, last + 2 + restart_after, true, jump);
  EXPECT_EQ(samples::warnings(earth_monitor_, "far_position"),
            static_cast<std::uint64_t>(kShort + restart_after));
  EXPECT_EQ(earth_monitor_.health(), HealthLevel::kDegraded) << "starts over from there";
}

TEST_F(V2xStageTest, AlternatingStationsMakeOneListWithIncreasingStamps) {
  drive(0, kSteps);
  ASSERT_TRUE(stage_.handleStation(listAt(kSteps, {120.0, 5.0}), stampAt(kSteps)));
  StationTracksMessage late = listAt(kSteps - 1, {140.0, -5.0});
  late.station = kPole + 1;
  EXPECT_EQ(stage_.handleStation(late, stampAt(kSteps)), nullptr) << "older than what is out";
  EXPECT_TRUE(monitor_.drops().empty());
  const TrackArrayPtr both =
      stage_.handleStation(listAt(kSteps + 1, {120.0, 5.0}), stampAt(kSteps + 1));
  ASSERT_TRUE(both);
  EXPECT_EQ(both->tracks.size(), 2U);
}

TEST_F(V2xStageTest, OursAreSentWithTheVehicleItself) {
  drive(0, kSteps);
  TrackArray tracks;
  tracks.header.frame_id = "map";
  tracks.header.stamp = toTime(stampAt(kSteps - 1));
  const StationTracksMessagePtr ours = stage_.handleTracks(tracks);
  ASSERT_TRUE(ours);
  ASSERT_EQ(ours->tracks.size(), 1U);
  EXPECT_EQ(ours->tracks[0].id, 0U);
  EXPECT_NEAR(std::hypot(ours->tracks[0].velocity_east, ours->tracks[0].velocity_north), kSpeed,
              0.1);
  // A station that receives it locates the vehicle correctly: middleAhead of base_link.
  const StationTrackList received = fromMessage(*ours, plane_);
  const Point2 middle(kSpeed * kPeriod * (kSteps - 1) + HostVehicleOptions().middleAhead(), 0.0);
  EXPECT_LT((received.tracks[0].position - kMap * middle).norm(), 0.1);
}

TEST_F(V2xStageTest, InvalidTracksOfOursAreNotSent) {
  drive(0, kSteps);
  Track track;
  track.id = 4;
  TrackList list;
  list.stamp = stampAt(kSteps - 1);
  list.tracks.assign(3, track);
  list.tracks[1].height = std::numeric_limits<double>::max();  // none that a float could hold
  list.tracks[2].state[2] = std::nan("");
  const StationTracksMessagePtr ours = stage_.handleTracks(toMessage(list, "map"));
  ASSERT_TRUE(ours);
  EXPECT_EQ(ours->tracks.size(), 2U) << "the vehicle, and the first track";
  EXPECT_EQ(contentFault(*ours), "");
  EXPECT_EQ(samples::warnings(monitor_, "bad_own_track"), 1U);
}

TEST_F(V2xStageTest, ReceiverWithoutFixOrOffTheEarthIsDropped) {
  sensor_msgs::NavSatFix fix;
  fix.header.stamp = toTime(stampAt(0));
  fix.header.frame_id = "antenna";
  fix.status.status = sensor_msgs::NavSatStatus::STATUS_NO_FIX;
  earth_.handleFix(fix);
  EXPECT_EQ(samples::drops(earth_monitor_, "no_fix"), 1U);
  fix.status.status = sensor_msgs::NavSatStatus::STATUS_FIX;
  fix.latitude = std::nan("");
  earth_.handleFix(fix);
  EXPECT_EQ(samples::drops(earth_monitor_, "bad_position"), 1U);
  fix.latitude = 45.0;
  fix.header.frame_id = "elsewhere";
  earth_.handleFix(fix);
  EXPECT_EQ(samples::drops(earth_monitor_, "missing_transform"), 1U);
}

TEST(EarthFrameConversion, ImpossiblePosesAndCovariancesAreRefused) {
  const LocalPlane plane{{degrees(45.19), degrees(5.72), 212.0}};
  const EarthFrame good{stampAt(0), plane, {kMap, Eigen::Matrix3d::Identity()}};
  const auto reason = [&good](const std::function<void(EarthFrameMessage&)>& spoil) {
    EarthFrameMessage message = toMessage(good, "map");
    spoil(message);
    return samples::reasonOf([&] { fromMessage(message); });
  };
  EXPECT_EQ(reason([](auto& /*message*/) {}), "");
  EXPECT_EQ(reason([](auto& message) { message.pose.x = 1e12; }), "bad_earth_frame");
  EXPECT_EQ(reason([](auto& message) { message.covariance[0] = 1e300; }), "bad_earth_frame");
  EXPECT_EQ(reason([](auto& message) { message.covariance[8] = std::nan(""); }), "bad_earth_frame");
  EXPECT_EQ(reason([](auto& message) { message.covariance[4] = 0.0; }), "bad_earth_frame");
  EXPECT_EQ(reason([](auto& message) { message.covariance[2] += 0.1; }), "bad_earth_frame")
      << "not symmetric";
}

TEST(NavSatFixCovariance, OfAnImpossibleFixIsNotAccepted) {
  sensor_msgs::NavSatFix fix;
  fix.position_covariance_type = sensor_msgs::NavSatFix::COVARIANCE_TYPE_DIAGONAL_KNOWN;
  const Eigen::Matrix2d assumed = 9.0 * Eigen::Matrix2d::Identity();
  for (const double variance : {std::numeric_limits<double>::denorm_min(), 1e308}) {
    fix.position_covariance = {variance, 0.0, 0.0, 0.0, variance, 0.0, 0.0, 0.0, 1.0};
    EXPECT_EQ(covarianceOf(fix, 3.0), assumed) << variance;
  }
  fix.position_covariance = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};
  EXPECT_EQ(covarianceOf(fix, 3.0), Eigen::Matrix2d::Identity());
}

}  // namespace
}  // namespace datmo::v2x_stage_test
