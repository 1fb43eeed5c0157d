// SPDX-License-Identifier: BSD-3-Clause
// Stations whose ids rarely repeat, and those that look like it at their start.
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "station_samples.h"
#include <gtest/gtest.h>

#include "datmo_fusion/fusion/earth/station_tracks.h"

namespace datmo::station_renaming_test {
namespace {

using station_samples::listAt;
using station_samples::mapInPlane;
using station_samples::numbered;
using station_samples::pathAt;

TEST(StationTracks, TracksOfARenamingStationAreIgnored) {
  StationTracks stations{StationTrackOptions()};
  std::size_t passed = 0;
  constexpr int kSteps = 100;
  for (int step = 0; step < kSteps; ++step) {
    const Pose2 direction(0.0, 0.0, 2.4 * step);
    const Point2 anywhere = pathAt(0) + direction.rotate({20.0 + step % 7, 0.0});
    passed += stations
                  .toMap(listAt(step, {numbered(static_cast<std::uint32_t>(step), anywhere)}),
                         mapInPlane(), std::nullopt)
                  .tracks.size();
  }
  EXPECT_LE(passed, 3U);
  EXPECT_EQ(stations.counts().sudden, kSteps - passed);
  EXPECT_EQ(stations.counts().jumped, 0U);
}

TEST(StationTracks, TracksOfAStationThatAlsoRenamesItsPartsAreIgnored) {
  StationTracks stations{StationTrackOptions()};
  std::size_t passed = 0;
  for (int step = 0; step < 100; ++step) {
    const auto id = static_cast<std::uint32_t>(step);
    const Point2 anywhere = pathAt(0) + Pose2(0.0, 0.0, 2.4 * step).rotate({20.0 + step % 7, 0.0});
    StationTrackList list = listAt(step, {numbered(id, anywhere)});
    list.part = id;
    passed += stations.toMap(list, mapInPlane(), std::nullopt).tracks.size();
  }
  EXPECT_LE(passed, 10U) << "those before its first parts no longer serve";
}

TEST(StationTracks, AllPartsOfAFirstMessageAreAccepted) {
  StationTracks stations{StationTrackOptions()};
  for (std::uint32_t part = 1; part <= 2; ++part) {
    std::vector<StationTrack> tracks;
    for (std::uint32_t i = 0; i < 5; ++i) {
      tracks.push_back(numbered(10 * part + i, pathAt(0) + Point2(20.0 * part, 10.0 * i)));
    }
    StationTrackList list = listAt(0, tracks);
    list.part = part;
    EXPECT_EQ(stations.toMap(list, mapInPlane(), std::nullopt).tracks.size(), 5U) << part;
  }
  EXPECT_EQ(stations.counts().sudden, 0U);
}

TEST(StationTracks, NewTracksInASecondMessageAreAccepted) {
  StationTracks stations{StationTrackOptions()};
  std::vector<StationTrack> tracks;
  for (std::uint32_t i = 0; i < 5; ++i) {
    tracks.push_back(numbered(i, pathAt(0) + Point2(0.0, 10.0 * i)));
  }
  stations.toMap(listAt(0, tracks), mapInPlane(), std::nullopt);
  tracks.push_back(numbered(5, pathAt(0) + Point2(20.0, 0.0)));
  EXPECT_EQ(stations.toMap(listAt(1, tracks), mapInPlane(), std::nullopt).tracks.size(), 6U);
}

TEST(StationTracks, ItsOwnPositionIsStillUsed) {
  StationTracks stations{StationTrackOptions()};
  for (int step = 0; step < 100; ++step) {
    const auto id = static_cast<std::uint32_t>(step);
    ASSERT_EQ(stations.toMap(listAt(step, {numbered(id, pathAt(step))}), mapInPlane(), std::nullopt)
                  .tracks.size(),
              1U)
        << step;
  }
  EXPECT_EQ(stations.counts().sudden, 0U);
}

TEST(StationTracks, NewTracksOfAStableStationAreAcceptedImmediately) {
  StationTracks stations{StationTrackOptions()};
  for (int step = 0; step < 60; ++step) {
    std::vector<StationTrack> tracks{numbered(1000, pathAt(step)),
                                     numbered(1001, pathAt(step + 90))};
    const int passing = step / 5;  // another one every half second, anywhere
    const Point2 where = pathAt(step) + Pose2(0.0, 0.0, 2.4 * passing).rotate({40.0, 0.0});
    tracks.push_back(numbered(static_cast<std::uint32_t>(passing), where));
    ASSERT_EQ(stations.toMap(listAt(step, tracks), mapInPlane(), std::nullopt).tracks.size(), 3U)
        << step;
  }
  EXPECT_EQ(stations.counts().sudden, 0U);
}

TEST(StationTracks, ARepeatedTrackOfARenamingStationIsUsed) {
  StationTracks stations{StationTrackOptions()};
  for (int step = 0; step < 10; ++step) {
    const Point2 anywhere = pathAt(0) + Point2(20.0 * step, 0.0);
    stations.toMap(listAt(step, {numbered(static_cast<std::uint32_t>(step), anywhere)}),
                   mapInPlane(), std::nullopt);
  }
  std::vector<std::size_t> passed;
  for (int step = 10; step < 14; ++step) {
    passed.push_back(
        stations.toMap(listAt(step, {numbered(500, pathAt(step))}), mapInPlane(), std::nullopt)
            .tracks.size());
  }
  EXPECT_EQ(passed, (std::vector<std::size_t>{0, 1, 1, 1}));
}

}  // namespace
}  // namespace datmo::station_renaming_test
