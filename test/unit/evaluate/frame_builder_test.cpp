// SPDX-License-Identifier: BSD-3-Clause
#include "evaluate/frame_builder.h"

#include "evaluate/made_recordings.h"
#include <gtest/gtest.h>

namespace datmo::evaluation::frame_builder_test {
namespace {

/// A car that drives along x from 10 m, for `seconds`, in front of a standing vehicle.
RecordedTruth drivingCar(double seconds = 2.0) {
  RecordedTruth truth{{}, standingVehicle(), std::nullopt};
  for (int i = 0; 0.1 * i <= seconds + 1e-9; ++i) {
    truth.objects.push_back({Stamp::fromSeconds(0.1 * i), {carAt(1, 10.0 + i)}});
  }
  return truth;
}

RecordedTracks tracksAt(double seconds, const std::vector<RecordedTrack>& tracks) {
  return {Stamp::fromSeconds(seconds), tracks};
}

BuiltFrames build(const std::vector<RecordedTracks>& tracks, const RecordedTruth& truth,
                  const ScoreOptions& options, const std::vector<StampedPose>& estimated) {
  const TrueScene scene(truth, options);
  const Trajectory trajectory(estimated, options.max_gap);
  return buildFrames(tracks, trajectory, alignAtFirstPose(trajectory, scene.trajectory()), scene,
                     options);
}

/// Returns only the frames, of a run whose poses are true.
Frames framesOf(const std::vector<RecordedTracks>& tracks, const RecordedTruth& truth,
                ScoreOptions options = optionsForBriefObjects()) {
  return build(tracks, truth, options, standingVehicle()).frames;
}

std::size_t trackCount(const Frames& frames, Stamp stamp) {
  for (const Frame& frame : frames) {
    if (frame.stamp == stamp) {
      return frame.tracks.size();
    }
  }
  ADD_FAILURE() << "no frame at " << stamp.seconds();
  return 0;
}

TEST(BuildFrames, TruthIsInterpolatedToTheStampsOfTheTracks) {
  const auto frames = framesOf({tracksAt(0.05, {}), tracksAt(0.15, {})}, drivingCar(0.2));
  ASSERT_EQ(frames.size(), 2U);
  EXPECT_NEAR(frames[0].truths.at(0).box.center.x(), 10.5, 1e-9);
  EXPECT_NEAR(frames[1].truths.at(0).box.center.x(), 11.5, 1e-9);
}

TEST(BuildFrames, SilenceIsFramesWithoutTracks) {
  // Tracks at 1.0 s alone; of the truth's 21 stamps 5 are within 0.2 s of it.
  const auto frames = framesOf({tracksAt(1.0, {movingTrackAt(7, 20.0)})}, drivingCar());
  ASSERT_EQ(frames.size(), 17U);
  std::size_t with_tracks = 0;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    with_tracks += frames[i].tracks.empty() ? 0U : 1U;
    EXPECT_EQ(frames[i].truths.size(), 1U);
    EXPECT_TRUE(i == 0 || frames[i - 1].stamp < frames[i].stamp);
  }
  EXPECT_EQ(with_tracks, 1U);
}

TEST(BuildFrames, MessagesOutsideOfTheTruthAreCountedAndLeftOut) {
  const auto built = build({tracksAt(1.0, {}), tracksAt(3.0, {}), tracksAt(4.0, {})}, drivingCar(),
                           optionsForBriefObjects(), standingVehicle());
  EXPECT_EQ(built.left_out, 2U);
}

TEST(BuildFrames, WithoutOverlapThereIsNoFrame) {
  EXPECT_TRUE(framesOf({tracksAt(50.0, {})}, drivingCar()).empty());
}

TEST(BuildFrames, StationaryTracksDoNotCountByDefault) {
  RecordedTrack standing = movingTrackAt(7, 20.0);
  standing.moving = false;
  const Stamp stamp = Stamp::fromSeconds(1.0);
  EXPECT_EQ(trackCount(framesOf({tracksAt(1.0, {standing})}, drivingCar()), stamp), 0U);
  ScoreOptions options = optionsForBriefObjects();
  options.moving_tracks_only = false;
  EXPECT_EQ(trackCount(framesOf({tracksAt(1.0, {standing})}, drivingCar(), options), stamp), 1U);
}

TEST(BuildFrames, TracksOutOfTheRegionCountOnlyOnAnObjectThatHasToBeFound) {
  ScoreOptions options = optionsForBriefObjects();
  options.region.range = 20.5;
  const Stamp stamp = Stamp::fromSeconds(1.0);  // the car is at 20 m, its front at 22 m
  const auto frames = framesOf(
      {tracksAt(1.0, {movingTrackAt(7, 23.9), movingTrackAt(8, 24.1), movingTrackAt(9, -30.0)})},
      drivingCar(), options);
  ASSERT_EQ(trackCount(frames, stamp), 1U);
}

TEST(BuildFrames, BriefObjectsNeedNotBeFound) {
  ScoreOptions options;
  std::vector<RecordedTracks> tracks;
  for (int i = 0; i <= 20; ++i) {
    tracks.push_back(tracksAt(0.1 * i, {}));
  }
  options.truth.min_time_seen = 1.95;
  EXPECT_EQ(framesOf(tracks, drivingCar(), options).at(5).truths.at(0).duty, Duty::kRequired);
  options.truth.min_time_seen = 2.05;
  EXPECT_EQ(framesOf(tracks, drivingCar(), options).at(5).truths.at(0).duty, Duty::kOptional);
}

TEST(BuildFrames, InASingleFrameObjectsAreThereForNoTime) {
  const auto duty = [](double min_time_seen) {
    ScoreOptions options;
    options.truth.min_time_seen = min_time_seen;
    const auto frames = framesOf({tracksAt(0.1, {})}, drivingCar(0.2), options);
    EXPECT_EQ(frames.size(), 1U);
    return frames.at(0).truths.at(0).duty;
  };
  EXPECT_EQ(duty(0.0), Duty::kRequired);
  EXPECT_EQ(duty(0.1), Duty::kOptional);
}

/// A run whose map is rotated by 90 degrees relative to the truth's, and drifts by 3 m along the
/// path until 1 s.
std::vector<StampedPose> turnedAndDrifting() {
  std::vector<StampedPose> poses;
  for (int i = 0; i <= 20; ++i) {
    poses.push_back(poseAt(0.1 * i, Pose2(0.0, i < 10 ? 0.3 * i : 3.0, kPi / 2)));
  }
  return poses;
}

/// Returns where a track that the run has at (0, 13) at 1 s is placed by this alignment.
TrackState alignedTrack(TrackAlignment align) {
  ScoreOptions options = optionsForBriefObjects();
  options.align = align;
  RecordedTrack track = movingTrackAt(7, 0.0, 13.0);
  track.state.box.center = Pose2(0.0, 13.0, kPi / 2);
  track.state.velocity = Point2(0.0, 10.0);
  track.state.covariance.diagonal() << 1.0, 4.0, 9.0, 16.0;
  const auto built = build({tracksAt(1.0, {track})}, drivingCar(), options, turnedAndDrifting());
  for (const Frame& frame : built.frames) {
    if (!frame.tracks.empty()) {
      return frame.tracks.front();
    }
  }
  ADD_FAILURE() << "no track";
  return {};
}

TEST(BuildFrames, PoseAtStampRemovesTheDrift) {
  const TrackState track = alignedTrack(TrackAlignment::kPoseAtStamp);
  EXPECT_NEAR(track.box.center.x(), 10.0, 1e-9);
  EXPECT_NEAR(track.box.center.y(), 0.0, 1e-9);
  EXPECT_NEAR(track.box.center.heading(), 0.0, 1e-9);
  EXPECT_NEAR(track.velocity.x(), 10.0, 1e-9);
  EXPECT_NEAR((track.covariance.diagonal() - Eigen::Vector4d(4.0, 1.0, 16.0, 9.0)).norm(), 0.0,
              1e-9);
}

TEST(BuildFrames, FirstPoseLeavesTheDriftIn) {
  const TrackState track = alignedTrack(TrackAlignment::kFirstPose);
  EXPECT_NEAR(track.box.center.x(), 13.0, 1e-9);
  EXPECT_NEAR(track.box.center.y(), 0.0, 1e-9);
  EXPECT_NEAR(track.velocity.x(), 10.0, 1e-9);
}

TEST(BuildFrames, NoneLeavesTheMapUnchanged) {
  const TrackState track = alignedTrack(TrackAlignment::kNone);
  EXPECT_NEAR(track.box.center.x(), 0.0, 1e-9);
  EXPECT_NEAR(track.box.center.y(), 13.0, 1e-9);
}

}  // namespace
}  // namespace datmo::evaluation::frame_builder_test
