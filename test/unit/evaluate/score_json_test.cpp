// SPDX-License-Identifier: BSD-3-Clause
#include "evaluate/score_json.h"

#include "evaluate/made_recordings.h"
#include <gtest/gtest.h>

namespace datmo::evaluation::score_json_test {
namespace {

/// A car that drives along x from 10 m, for 2 s, in front of a stationary vehicle; a track half a
/// meter beside it from 0.5 s on.
struct Drive {
  RecordedRun run;
  RecordedTruth truth{{}, standingVehicle(), std::nullopt};

  Drive() {
    run.poses = standingVehicle();
    for (int i = 0; i <= 20; ++i) {
      const Stamp stamp = Stamp::fromSeconds(0.1 * i);
      truth.objects.push_back({stamp, {carAt(1, 10.0 + i)}});
      run.tracks.push_back({stamp, {}});
      if (i >= 5) {
        run.tracks.back().tracks.push_back(movingTrackAt(7, 10.0 + i, 0.5));
      }
    }
  }

  nlohmann::json report() const {
    const ScoreOptions options;
    return toJson(scoreRun(run, truth, options), options, {"run.bag", "truth.bag"});
  }
};

TEST(ScoreJson, HoldsTheScores) {
  const auto report = Drive().report();
  EXPECT_EQ(report["format"], 1);
  EXPECT_EQ(report["run"], "run.bag");
  EXPECT_EQ(report["truth"], "truth.bag");
  EXPECT_EQ(report["frames"], 21);
  EXPECT_EQ(report["messages_left_out"], 0);
  EXPECT_NEAR(report["duration_s"].get<double>(), 2.0, 1e-9);
  EXPECT_EQ(report["truth_objects"], 1);
  EXPECT_EQ(report["tracks"], 1);
  EXPECT_EQ(report["clear_mot"]["matches"], 16);
  EXPECT_EQ(report["clear_mot"]["misses"], 5);
  EXPECT_NEAR(report["errors"]["position_rmse_m"].get<double>(), 0.5, 1e-9);
  EXPECT_EQ(report["near_errors"]["range_m"], 20.0);
  EXPECT_EQ(report["near_errors"]["samples"], 6) << "at 15 m to 20 m";
  EXPECT_NEAR(report["near_errors"]["position_rmse_m"].get<double>(), 0.5, 1e-9);
  EXPECT_EQ(report["classes"]["right_share"], 0.0);
  EXPECT_EQ(report["classes"]["by_class"]["vehicle"]["silent"], 16);
  EXPECT_NEAR(report["delay"]["mean_s"].get<double>(), 0.5, 1e-9);
  EXPECT_EQ(report["delay"]["objects"], 1);
  EXPECT_NEAR(report["consistency"]["position"]["mean_nees"].get<double>(), 0.25, 1e-9);
  EXPECT_EQ(report["thesis"]["missed_objects"], 0);
}

TEST(ScoreJson, HoldsEachObject) {
  const auto object = Drive().report()["objects"].at(0);
  EXPECT_EQ(object["id"], 1);
  EXPECT_EQ(object["label"], "Car");
  EXPECT_EQ(object["class"], "vehicle");
  EXPECT_EQ(object["found"], true);
  EXPECT_NEAR(object["delay_s"].get<double>(), 0.5, 1e-9);
  EXPECT_EQ(object["track_ids"], nlohmann::json({7}));
  EXPECT_NEAR(object["completeness"].get<double>(), 16.0 / 21.0, 1e-9);
}

TEST(ScoreJson, SeriesHaveAValueForEachFrame) {
  const auto series = Drive().report()["series"];
  for (const char* name : {"time_s", "true_objects", "tracked", "missed", "false",
                           "position_error_m", "velocity_error_mps", "gospa_m", "pose_error_m"}) {
    EXPECT_EQ(series[name].size(), 21U) << name;
  }
  EXPECT_TRUE(series["position_error_m"].at(4).is_null());
  EXPECT_NEAR(series["position_error_m"].at(5).get<double>(), 0.5, 1e-9);
  const auto path = series["true_paths"].at(0);
  EXPECT_TRUE(path["track_id"].at(4).is_null());
  EXPECT_EQ(path["track_id"].at(5), 7);
  EXPECT_EQ(path["required"].at(0), true);
  EXPECT_NEAR(path["x_m"].at(5).get<double>(), 15.0, 1e-9);
  EXPECT_EQ(series["track_paths"].at(0)["time_s"].size(), 16U);
  EXPECT_EQ(series["ego_true"]["x_m"].size(), 21U);
  EXPECT_EQ(series["ego_estimated"]["y_m"].size(), 21U);
}

TEST(ScoreJson, PartsThatTheRunDoesNotHaveAreNull) {
  const auto report = Drive().report();
  EXPECT_TRUE(report["timing"].is_null());
  for (const char* name : {"false_moving_objects_frames", "false_moving_objects_episodes",
                           "intersections", "intersections_found", "intersections_false"}) {
    EXPECT_TRUE(report["thesis"][name].is_null()) << name;
  }
  EXPECT_TRUE(report["pose"]["end_error_share"].is_null());  // it is stationary
}

TEST(ScoreJson, OptionalPartsArePresentIfTheRunHasThem) {
  Drive drive;
  drive.run.detections.emplace({RecordedDetections{Stamp::fromSeconds(1.0), {Point2(5.0, 9.0)}}});
  drive.truth.intersections.emplace({RecordedIntersection{Stamp::fromSeconds(1.0), true}});
  drive.run.intersections.emplace({RecordedIntersection{Stamp::fromSeconds(1.0), true}});
  drive.run.durations["tracker"] = {{0.001, 0.003, 0.002}, {}};
  drive.run.durations["grid_slam"] = {{0.001}, {0.004}};
  const auto report = drive.report();
  EXPECT_NEAR(report["thesis"]["false_moving_objects_frames"].get<double>(), 1.0, 1e-9);
  EXPECT_EQ(report["thesis"]["false_moving_objects_episodes"], 1);
  EXPECT_EQ(report["thesis"]["intersections"], 1);
  EXPECT_EQ(report["thesis"]["intersections_found"], 1);
  EXPECT_EQ(report["thesis"]["intersections_false"], 0);
  EXPECT_NEAR(report["timing"]["tracker"]["median_ms"].get<double>(), 2.0, 1e-9);
  EXPECT_NEAR(report["timing"]["tracker"]["worst_ms"].get<double>(), 3.0, 1e-9);
  EXPECT_TRUE(report["timing"]["tracker"]["latency"].is_null());
  EXPECT_NEAR(report["timing"]["grid_slam"]["latency"]["p99_ms"].get<double>(), 4.0, 1e-9);
}

TEST(ScoreJson, OptionsAreUnderTheirKeys) {
  const auto options = Drive().report()["options"];
  EXPECT_EQ(options["align"], "pose_at_stamp");
  EXPECT_EQ(options["region/range"], 50.0);
  EXPECT_EQ(options["truth/classes/vehicle"], true);
  EXPECT_EQ(options["truth/min_beams"], 0);
  EXPECT_EQ(options["matching/gate"], 2.0);
}

TEST(ScoreRun, WithoutPosesThereIsNoPoseScore) {
  Drive drive;
  drive.run.poses.clear();
  ScoreOptions options;
  options.align = TrackAlignment::kNone;
  const RunScore score = scoreRun(drive.run, drive.truth, options);
  EXPECT_FALSE(score.pose);
  EXPECT_EQ(score.tracks.clear_mot.matches, 16U);
  EXPECT_TRUE(toJson(score, options, {"a", "b"})["pose"].is_null());
}

TEST(ScoreRun, StampsThatDoNotOverlapAreNamed) {
  Drive drive;
  for (RecordedTracks& tracks : drive.run.tracks) {
    tracks.stamp = tracks.stamp + 500.0;
  }
  try {
    scoreRun(drive.run, drive.truth, {});
    FAIL() << "no exception";
  } catch (const ScoreError& error) {
    const std::string what = error.what();
    EXPECT_NE(what.find("tracks from 500.000 s to 502.000 s"), std::string::npos) << what;
    EXPECT_NE(what.find("true objects from 0.000 s to 2.000 s"), std::string::npos) << what;
  }
}

TEST(ScoreRun, OptionsOutOfBoundsAreRefused) {
  Drive drive;
  ScoreOptions options;
  options.region.range = -1.0;
  EXPECT_THROW(scoreRun(drive.run, drive.truth, options), OptionError);
}

}  // namespace
}  // namespace datmo::evaluation::score_json_test
