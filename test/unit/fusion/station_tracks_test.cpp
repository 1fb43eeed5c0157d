// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/fusion/earth/station_tracks.h"

#include <cmath>
#include <random>

#include "station_samples.h"
#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <gtest/gtest.h>

#include "datmo_fusion/common/angle.h"

namespace datmo {
namespace {

using station_samples::kMap;
using station_samples::listAt;
using station_samples::mapInPlane;
using station_samples::pathAt;
using station_samples::walker;

TEST(StationTracks, KeepTheirPositionAndGetTheUncertaintyOfTheFrame) {
  StationTracks stations{StationTrackOptions()};
  const TrackList list = stations.toMap(listAt(0, {walker(pathAt(0))}), mapInPlane(), std::nullopt);
  ASSERT_EQ(list.tracks.size(), 1U);
  const Track& track = list.tracks.front();
  EXPECT_LT((kMap * track.box.center.position() - pathAt(0)).norm(), 1e-9);
  EXPECT_LT((kMap.rotate(track.state.segment<2>(2)) - Point2(1.2, 0.5)).norm(), 1e-9);
  const double distance = track.box.center.position().norm();
  const double position_trace = track.covariance.topLeftCorner<2, 2>().trace();
  EXPECT_NEAR(position_trace, 0.18 + 0.5 + 1e-4 * distance * distance + 0.05 * 0.05 * 1.69, 1e-6);
  EXPECT_EQ(track.sensors, (std::vector<std::string>{"station 3"}));
}

TEST(StationTracks, PartsOfAStationAreMerged) {
  StationTracks stations{StationTrackOptions()};
  StationTrackList first = listAt(0, {walker(pathAt(0))});
  first.part = 1;
  StationTrack other = walker(pathAt(0) + Point2(10.0, 0.0));
  other.id = 8;
  StationTrackList second = listAt(0, {other});
  second.part = 2;
  stations.toMap(first, mapInPlane(), std::nullopt);
  EXPECT_FALSE(stations.isNew(first));
  ASSERT_TRUE(stations.isNew(second));
  stations.toMap(second, mapInPlane(), std::nullopt);
  EXPECT_EQ(stations.merged(second.stamp).tracks.size(), 2U);

  StationTrackList next = listAt(1, {});
  next.part = 1;
  stations.toMap(next, mapInPlane(), std::nullopt);
  EXPECT_EQ(stations.merged(next.stamp).tracks.size(), 1U);
}

TEST(StationTracks, ATrackThatMovesToAnotherPartIsInTheListOnce) {
  StationTracks stations{StationTrackOptions()};
  for (const int part : {1, 2}) {
    StationTrackList list = listAt(0, {walker(pathAt(0))});
    list.part = static_cast<std::uint32_t>(part);
    stations.toMap(list, mapInPlane(), std::nullopt);
  }
  EXPECT_EQ(stations.merged(listAt(0, {}).stamp).tracks.size(), 1U);
}

TEST(StationTracks, CovarianceIsConsistent) {
  // Errors drawn as the covariances say: mean NEES of position and velocity, 4 degrees of freedom.
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  StationTrackOptions options;
  double nees = 0.0;
  constexpr int kDraws = 2000;
  for (int i = 0; i < kDraws; ++i) {
    StationTracks stations(options);
    PoseWithCovariance map = mapInPlane();
    Eigen::Vector3d frame_error;
    Eigen::Vector4d track_error;
    for (int k = 0; k < 3; ++k) {
      frame_error(k) = std::sqrt(map.covariance(k, k)) * normal(random);
    }
    StationTrack track = walker(pathAt(0));
    for (int k = 0; k < 4; ++k) {
      track_error(k) = std::sqrt(track.covariance(k, k)) * normal(random);
    }
    map.pose = Pose2(kMap.x() + frame_error(0), kMap.y() + frame_error(1),
                     kMap.heading() + frame_error(2));
    const double late = options.clock_sigma * normal(random);
    track.position += late * track.velocity + track_error.head<2>();
    track.velocity += track_error.tail<2>();
    const TrackList list = stations.toMap(listAt(0, {track}), map, std::nullopt);
    const Track& got = list.tracks.front();
    Eigen::Vector4d error;
    error << got.state.head<2>() - kMap.inverse() * pathAt(0),
        got.state.segment<2>(2) - kMap.inverse().rotate(Point2(1.2, 0.5));
    nees += error.dot(got.covariance.topLeftCorner<4, 4>().inverse() * error) / kDraws;
  }
  EXPECT_NEAR(nees, 4.0, 0.25);  // 4 sigma of the mean
}

TEST(StationTracks, IdStaysAndIsNotShared) {
  StationTracks stations{StationTrackOptions()};
  const auto first = stations.toMap(listAt(0, {walker(pathAt(0))}), mapInPlane(), std::nullopt);
  StationTrackList other = listAt(1, {walker(pathAt(1))});
  other.station = 4;
  const auto second = stations.toMap(other, mapInPlane(), std::nullopt);
  const auto third = stations.toMap(listAt(1, {walker(pathAt(1))}), mapInPlane(), std::nullopt);
  EXPECT_EQ(first.tracks.at(0).id, third.tracks.at(0).id);
  EXPECT_NE(first.tracks.at(0).id, second.tracks.at(0).id);
}

TEST(StationTracks, OldListThatIsRepeatedIsNotNew) {
  StationTracks stations{StationTrackOptions()};
  const StationTrackList list = listAt(5, {walker(pathAt(5))});
  EXPECT_TRUE(stations.isNew(list));
  stations.toMap(list, mapInPlane(), std::nullopt);
  EXPECT_FALSE(stations.isNew(list));
  EXPECT_FALSE(stations.isNew(listAt(4, {})));
  EXPECT_TRUE(stations.isNew(listAt(6, {})));
}

TEST(StationTracks, JumpIsLeftOutUntilSeveralFit) {
  StationTracks stations{StationTrackOptions()};
  std::vector<std::size_t> passed;
  for (int step = 0; step < 12; ++step) {
    const Point2 jump = step >= 5 ? Point2(30.0, 0.0) : Point2(0.0, 0.0);
    passed.push_back(
        stations.toMap(listAt(step, {walker(pathAt(step) + jump)}), mapInPlane(), std::nullopt)
            .tracks.size());
  }
  EXPECT_EQ(passed, (std::vector<std::size_t>{1, 1, 1, 1, 1, 0, 0, 0, 1, 1, 1, 1}));
  EXPECT_EQ(stations.counts().jumped, 3U);
}

TEST(StationTracks, TwoHundredKilometersAnHourAreLeftOut) {
  StationTracks stations{StationTrackOptions()};
  StationTrack fast = walker(pathAt(0));
  fast.velocity = {200.0 / 3.6, 0.0};
  EXPECT_TRUE(stations.toMap(listAt(0, {fast}), mapInPlane(), std::nullopt).tracks.empty());
  EXPECT_EQ(stations.counts().fast, 1U);
}

TEST(StationTracks, BadNumbersAreLeftOut) {
  StationTracks stations{StationTrackOptions()};
  StationTrack nowhere = walker(pathAt(0));
  nowhere.position.x() = std::nan("");
  StationTrack sure = walker(pathAt(0));
  sure.id = 8;
  sure.covariance(0, 0) = -1.0;
  EXPECT_TRUE(
      stations.toMap(listAt(0, {nowhere, sure}), mapInPlane(), std::nullopt).tracks.empty());
  EXPECT_EQ(stations.counts().invalid, 2U);
}

TEST(StationTracks, OwnVehicleIsRemovedAndAPedestrianBesideItIsNot) {
  StationTracks stations{StationTrackOptions()};
  OwnVehicle own;
  own.box = {Pose2(10.0, 5.0, 0.3), 4.6, 1.85};
  own.velocity = Pose2(0.0, 0.0, 0.3).rotate({8.0, 0.0});
  own.covariance = 0.01 * Eigen::Matrix2d::Identity();
  StationTrack seen = walker(kMap * Point2(10.6, 5.3));
  seen.velocity = kMap.rotate(own.velocity);
  seen.class_probabilities = {};
  seen.class_probabilities[static_cast<std::size_t>(ObjectClass::kVehicle)] = 0.9;
  StationTrack beside = walker(kMap * Point2(10.0, 6.5));
  beside.id = 9;
  StationTrack oncoming = seen;
  oncoming.id = 10;
  oncoming.velocity = -seen.velocity;
  const TrackList list = stations.toMap(listAt(0, {seen, beside, oncoming}), mapInPlane(), own);
  EXPECT_EQ(list.tracks.size(), 2U);
  EXPECT_EQ(stations.counts().own, 1U);
}

TEST(StationTracks, AnObjectOfTwoStationsIsMergedAtOneTime) {
  StationTracks stations{StationTrackOptions()};
  stations.toMap(listAt(0, {walker(pathAt(0))}), mapInPlane(), std::nullopt);
  StationTrackList other = listAt(2, {walker(pathAt(2)), walker(pathAt(2) + Point2(15.0, 0.0))});
  other.station = 4;
  other.tracks[0].covariance *= 2.0;
  other.tracks[1].id = 11;
  const TrackList theirs = stations.toMap(other, mapInPlane(), std::nullopt);
  const TrackList list = stations.merged(theirs.stamp);
  ASSERT_EQ(list.tracks.size(), 2U);
  EXPECT_EQ(stations.counts().twice, 1U);
  EXPECT_EQ(list.tracks[0].sensors, (std::vector<std::string>{"station 3"}));
  EXPECT_LT((kMap * list.tracks[0].box.center.position() - pathAt(2)).norm(), 1e-6);
  EXPECT_EQ(stations.merged(theirs.stamp + 1.0).tracks.size(), 0U);  // too old by then
}

TEST(StationTracks, OursAreUnchangedByARoundTrip) {
  StationTracks stations{StationTrackOptions()};
  const TrackList list = stations.toMap(listAt(0, {walker(pathAt(0))}), mapInPlane(), std::nullopt);
  const StationTrack ours = toStation(list.tracks.front(), mapInPlane());
  EXPECT_LT((ours.position - pathAt(0)).norm(), 1e-9);
  EXPECT_LT((ours.velocity - Point2(1.2, 0.5)).norm(), 1e-9);
  EXPECT_GT(ours.covariance(0, 0), 0.09);
}

}  // namespace
}  // namespace datmo
