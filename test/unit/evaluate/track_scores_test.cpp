// SPDX-License-Identifier: BSD-3-Clause
#include "evaluate/track_scores.h"

#include <algorithm>
#include <random>

#include "made_frames.h"
#include <gtest/gtest.h>

namespace datmo::evaluation::track_scores_test {
namespace {

/// Objects on straight paths, some of them optional, followed by tracks with errors, losses and id
/// switches, and by false ones.
Frames randomRun(std::uint64_t seed) {
  std::mt19937_64 engine(seed);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  std::normal_distribution<double> noise(0.0, 0.6);
  FrameMaker maker;
  std::vector<std::uint32_t> track_of{1, 2, 3, 4, 5};
  std::uint32_t next_track = 6;
  for (int step = 0; step < 60; ++step) {
    std::vector<TrueState> truths;
    std::vector<TrackState> tracks;
    for (std::uint32_t object = 0; object < track_of.size(); ++object) {
      const double x = 0.3 * step;
      const double y = 2.0 * object;
      truths.push_back(uniform(engine) < 0.2 ? optionalAt(object, x, y) : truthAt(object, x, y));
      track_of[object] = uniform(engine) < 0.05 ? next_track++ : track_of[object];
      if (uniform(engine) < 0.8) {
        const double error = noise(engine);
        tracks.push_back(trackAt(track_of[object], x + error, y + noise(engine)));
      }
    }
    tracks.push_back(trackAt(1000, -20.0 * uniform(engine), 0.0));
    maker.add(truths, tracks);
  }
  return maker.frames();
}

void expectSame(const TrackScores& a, const TrackScores& b) {
  EXPECT_EQ(a.clear_mot.mota, b.clear_mot.mota);
  EXPECT_EQ(a.clear_mot.switches.size(), b.clear_mot.switches.size());
  EXPECT_EQ(a.clear_mot.fragmentations, b.clear_mot.fragmentations);
  EXPECT_NEAR(a.clear_mot.motp.value(), b.clear_mot.motp.value(), 1e-12);
  EXPECT_EQ(a.identity.idf1, b.identity.idf1);
  EXPECT_NEAR(a.hota.hota.value(), b.hota.hota.value(), 1e-12);
  EXPECT_NEAR(a.gospa->total, b.gospa->total, 1e-12);
  EXPECT_NEAR(a.errors.position.value(), b.errors.position.value(), 1e-12);
  EXPECT_EQ(a.thesis.false_tracks, b.thesis.false_tracks);
}

class RandomRuns : public testing::TestWithParam<std::uint64_t> {};

TEST_P(RandomRuns, TheSumsAreConsistent) {
  const TrackScores scores = scoreTracks(randomRun(GetParam()), TrackScoreOptions());
  const ClearMot& clear_mot = scores.clear_mot;
  EXPECT_EQ(clear_mot.matches + clear_mot.misses, clear_mot.required);
  EXPECT_EQ(clear_mot.matches, scores.errors.samples);
  EXPECT_EQ(clear_mot.matches, scores.consistency.position.samples);
  EXPECT_EQ(scores.objects.size(), scores.thesis.moving_objects);
  std::size_t required = 0;
  std::size_t misses = 0;
  std::size_t false_positives = 0;
  for (const FrameScore& frame : scores.frames) {
    required += frame.required;
    misses += frame.misses();
    false_positives += frame.false_positives;
  }
  EXPECT_EQ(required, clear_mot.required);
  EXPECT_EQ(misses, clear_mot.misses);
  EXPECT_EQ(false_positives, clear_mot.false_positives);
  std::size_t tracked = 0;
  for (const ObjectScore& object : scores.objects) {
    tracked += object.tracked_frames;
  }
  EXPECT_EQ(tracked, clear_mot.matches);
}

TEST_P(RandomRuns, HotaIsTheGeometricMeanAndInBounds) {
  const HotaScores hota = scoreTracks(randomRun(GetParam()), TrackScoreOptions()).hota;
  EXPECT_GT(hota.hota.value(), 0.0);
  EXPECT_LT(hota.hota.value(), 1.0);
  // Averaged over alpha it is an upper bound (Cauchy-Schwarz).
  EXPECT_LE(hota.hota.value(), std::sqrt(hota.deta.value() * hota.assa.value()) + 1e-12);
  // There are at least as many matches at lower alphas as at one alpha.
  EXPECT_GT(hota.hota_alpha.front(), hota.hota_alpha.back());
}

TEST_P(RandomRuns, OrderWithinAFrameAndNamesOfIdsDoNotMatter) {
  const Frames frames = randomRun(GetParam());
  Frames renamed = frames;
  for (Frame& frame : renamed) {
    std::reverse(frame.truths.begin(), frame.truths.end());
    std::reverse(frame.tracks.begin(), frame.tracks.end());
    for (TrackState& track : frame.tracks) {
      track.id = 5000 - track.id;
    }
    for (TrueState& truth : frame.truths) {
      truth.id += 77;
    }
  }
  expectSame(scoreTracks(frames, TrackScoreOptions()), scoreTracks(renamed, TrackScoreOptions()));
}

TEST_P(RandomRuns, NoTracksAtAll) {
  Frames frames = randomRun(GetParam());
  for (Frame& frame : frames) {
    frame.tracks.clear();
  }
  const TrackScores scores = scoreTracks(frames, TrackScoreOptions());
  EXPECT_DOUBLE_EQ(scores.clear_mot.mota.value(), 0.0);
  EXPECT_DOUBLE_EQ(scores.hota.hota.value(), 0.0);
  EXPECT_DOUBLE_EQ(scores.identity.idf1.value(), 0.0);
  EXPECT_DOUBLE_EQ(scores.gospa->total, scores.gospa->missed);
  EXPECT_EQ(scores.thesis.missed_objects, scores.thesis.moving_objects);
  EXPECT_FALSE(scores.errors.position);
}

TEST_P(RandomRuns, TheTruthItselfIsPerfect) {
  Frames frames = randomRun(GetParam());
  for (Frame& frame : frames) {
    frame.tracks.clear();
    for (const TrueState& truth : frame.truths) {
      frame.tracks.push_back(
          trackAt(truth.id, truth.box.center.position().x(), truth.box.center.position().y()));
    }
  }
  const TrackScores scores = scoreTracks(frames, TrackScoreOptions());
  EXPECT_DOUBLE_EQ(scores.clear_mot.mota.value(), 1.0);
  EXPECT_DOUBLE_EQ(scores.identity.idf1.value(), 1.0);
  EXPECT_NEAR(scores.hota.hota.value(), 1.0, 1e-12);
  EXPECT_EQ(scores.gospa->total, 0.0);
  EXPECT_EQ(scores.thesis.false_tracks + scores.thesis.missed_objects, 0U);
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomRuns, testing::Values(1, 2, 3, 4, 5));

TEST(TrackScores, AnEmptyRunHasNoScores) {
  const TrackScores scores = scoreTracks({}, TrackScoreOptions());
  EXPECT_FALSE(scores.clear_mot.mota || scores.identity.idf1 || scores.hota.hota || scores.gospa);
  EXPECT_TRUE(scores.objects.empty());
}

TEST(TrackScores, FramesForPlots) {
  TrackState track = trackAt(1, 0.0, 0.5);
  track.velocity = Point2(0.0, 2.0);
  const TrackScores scores = scoreTracks(
      FrameMaker()
          .add({}, {})
          .add({truthAt(1, 0.0), truthAt(2, 9.0)}, {track, trackAt(2, 50.0), trackAt(3, 60.0)})
          .frames(),
      TrackScoreOptions());
  ASSERT_EQ(scores.frames.size(), 2U);
  EXPECT_FALSE(scores.frames[0].position_error);
  EXPECT_EQ(scores.frames[1].stamp, Stamp::fromSeconds(1.0));
  EXPECT_EQ(scores.frames[1].required, 2U);
  EXPECT_EQ(scores.frames[1].matches, 1U);
  EXPECT_EQ(scores.frames[1].misses(), 1U);
  EXPECT_EQ(scores.frames[1].false_positives, 2U);
  EXPECT_DOUBLE_EQ(scores.frames[1].position_error.value(), 0.5);
  EXPECT_DOUBLE_EQ(scores.frames[1].velocity_error.value(), 2.0);
}

TEST(TrackScores, TheGateIsAnOption) {
  const Frames frames = FrameMaker().add({truthAt(1, 0.0)}, {trackAt(1, 2.5)}).frames();
  TrackScoreOptions options;
  EXPECT_EQ(scoreTracks(frames, options).clear_mot.matches, 0U);
  options.matching.gate = 3.0;
  EXPECT_EQ(scoreTracks(frames, options).clear_mot.matches, 1U);
}

TEST(TrackScores, OptionsOutOfBoundsAreRefused) {
  TrackScoreOptions no_gate;
  no_gate.matching.gate = 0.0;
  EXPECT_THROW(scoreTracks({}, no_gate), OptionError);
  EXPECT_THROW(readOptions<TrackScoreOptions>({{"matching/distance", std::string("to_moon")}}),
               OptionError);
}

}  // namespace
}  // namespace datmo::evaluation::track_scores_test
