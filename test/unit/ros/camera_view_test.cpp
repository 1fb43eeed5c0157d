// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/display/camera_view.h"

#include <cmath>

#include "camera_view_sample.h"
#include "monitor_counts.h"
#include <boost/make_shared.hpp>
#include <gtest/gtest.h>

namespace datmo::camera_view_test {
namespace {

using samples::drops;
using samples::warnings;

TEST_F(CameraViewTest, ATrackIsABoxAtItsImagePosition) {
  view_.handleCameraInfo(cameraInfo());
  mountCamera(kStart);
  view_.handleTracks(tracks(kStart, 12.0, 0.0));
  const auto picture = show(image(kStart));
  ASSERT_TRUE(picture);
  EXPECT_EQ(picture->encoding, "bgr8");
  EXPECT_EQ(picture->header.stamp, ros::Time(kStart));
  // Its rear, 10 m away: from 320 - 40 to 320 + 40 px, from 240 px (the roof is as high as the
  // camera) to 240 + 60 px.
  EXPECT_TRUE(isDrawn(*picture, 280, 270));
  EXPECT_TRUE(isDrawn(*picture, 360, 270));
  EXPECT_TRUE(isDrawn(*picture, 320, 300));
  EXPECT_FALSE(isDrawn(*picture, 270, 270));
  EXPECT_FALSE(isDrawn(*picture, 320, 310));
  EXPECT_EQ(monitor_.processedCount(), 1U);
}

TEST_F(CameraViewTest, ATrackIsPredictedToTheExposure) {
  view_.handleCameraInfo(cameraInfo());
  mountCamera(kStart);
  mountCamera(kStart + 0.5);
  // Drives away at 10 m/s: from 8 m to 12 m in 0.4 s, with its rear at 10 m.
  view_.handleTracks(tracks(kStart + 0.1, 8.0, 10.0));
  const auto picture = show(image(kStart + 0.5), 0.4);
  ASSERT_TRUE(picture);
  EXPECT_TRUE(isDrawn(*picture, 280, 270));
  EXPECT_TRUE(isDrawn(*picture, 320, 300));
  EXPECT_FALSE(isDrawn(*picture, 320, 340)) << "where it was";
}

TEST_F(CameraViewTest, LabelsDoNotCoverEachOther) {
  view_.handleCameraInfo(cameraInfo());
  mountCamera(kStart);
  const auto labelRows = [this](double seconds, const TrackArrayPtr& list) {
    mountCamera(seconds);
    view_.handleTracks(list);
    const auto picture = show(image(seconds));
    int rows = 0;  // above the box, where there are only labels
    for (int row = 0; picture && row < 238; ++row) {
      rows += isDrawn(*picture, 300, row) ? 1 : 0;
    }
    return rows;
  };
  const auto two = tracks(kStart + 0.1, 12.0, 0.0);
  two->tracks.push_back(two->tracks[0]);
  const int one = labelRows(kStart, tracks(kStart, 12.0, 0.0));
  EXPECT_GT(one, 10);
  EXPECT_EQ(labelRows(kStart + 0.1, two), 2 * one);
}

TEST_F(CameraViewTest, ATrackBehindTheCameraIsNotDrawn) {
  view_.handleCameraInfo(cameraInfo());
  mountCamera(kStart);
  view_.handleTracks(tracks(kStart, -12.0, 0.0));
  const auto picture = show(image(kStart));
  ASSERT_TRUE(picture);
  EXPECT_FALSE(anyDrawn(*picture));
}

TEST_F(CameraViewTest, AFarTrackIsNotDrawn) {
  view_.handleCameraInfo(cameraInfo());
  mountCamera(kStart);
  view_.handleTracks(tracks(kStart, 81.0, 0.0));
  const auto picture = show(image(kStart));
  ASSERT_TRUE(picture);
  EXPECT_FALSE(anyDrawn(*picture));
}

TEST_F(CameraViewTest, ARightCameraSeesItFartherToTheLeft) {
  auto info = cameraInfo();
  info.P[3] = -kFocalLength * 0.5;  // 0.5 m to the right of its frame's origin
  view_.handleCameraInfo(info);
  mountCamera(kStart);
  view_.handleTracks(tracks(kStart, 12.0, 0.0));
  const auto picture = show(image(kStart));
  ASSERT_TRUE(picture);
  EXPECT_TRUE(isDrawn(*picture, 260, 270)) << "280 px - 400 px * 0.5 m / 10 m";
}

TEST_F(CameraViewTest, AnImageWaitsForTracksThatAreNotOlderThanItself) {
  view_.handleCameraInfo(cameraInfo());
  mountCamera(kStart);
  view_.handleTracks(tracks(kStart - 0.1, 12.0, 0.0));
  EXPECT_FALSE(show(image(kStart)));
  view_.handleTracks(tracks(kStart, 12.0, 0.0));
  EXPECT_TRUE(view_.next(Stamp::fromSeconds(kStart + 0.05)));
}

TEST_F(CameraViewTest, AnImageWaitsForItsTransformAndIsDroppedWithoutOne) {
  view_.handleCameraInfo(cameraInfo());
  view_.handleTracks(tracks(kStart, 12.0, 0.0));
  EXPECT_FALSE(show(image(kStart)));
  EXPECT_EQ(monitor_.droppedCount(), 0U);
  mountCamera(kStart);
  EXPECT_TRUE(view_.next(Stamp::fromSeconds(kStart + 0.1)));
  view_.handleTracks(tracks(kStart + 0.2, 12.0, 0.0));
  EXPECT_FALSE(show(image(kStart + 0.2), 0.4));
  EXPECT_EQ(drops(monitor_, "missing_transform"), 1U);
}

TEST_F(CameraViewTest, AnImageThatWaitsWhileTheCameraChangesIsDropped) {
  view_.handleCameraInfo(cameraInfo());
  mountCamera(kStart);
  EXPECT_FALSE(show(image(kStart)));
  auto wider = cameraInfo();
  ++wider.width;
  view_.handleCameraInfo(wider);
  view_.handleTracks(tracks(kStart, 12.0, 0.0));
  EXPECT_FALSE(view_.next(Stamp::fromSeconds(kStart)));
  EXPECT_EQ(drops(monitor_, "wrong_size"), 1U);
}

TEST_F(CameraViewTest, OldTracksAreNotDrawn) {
  view_.handleCameraInfo(cameraInfo());
  mountCamera(kStart);
  view_.handleTracks(tracks(kStart - 0.6, 12.0, 0.0));
  const auto picture = show(image(kStart), 0.4);
  ASSERT_TRUE(picture) << "the image is shown all the same";
  EXPECT_FALSE(anyDrawn(*picture));
  EXPECT_EQ(warnings(monitor_, "old_tracks"), 1U);
}

TEST_F(CameraViewTest, ImagesThatDoNotFitTheirCameraInfoAreRefused) {
  show(image(kStart));
  EXPECT_EQ(drops(monitor_, "missing_camera_info"), 1U);
  view_.handleCameraInfo(cameraInfo());
  const auto small = image(kStart + 0.1);
  small->width = kWidth / 2;
  small->step = kWidth / 2;
  show(small);
  EXPECT_EQ(drops(monitor_, "wrong_size"), 1U);
  const auto other = image(kStart + 0.2);
  other->header.frame_id = "other_camera";
  show(other);
  EXPECT_EQ(drops(monitor_, "wrong_frame"), 1U);
}

TEST_F(CameraViewTest, ACameraInfoWithoutCalibrationIsRefused) {
  auto info = cameraInfo();
  info.P[0] = 0.0;
  view_.handleCameraInfo(info);
  info.P[0] = std::nan("");
  view_.handleCameraInfo(info);
  EXPECT_EQ(drops(monitor_, "bad_camera_info"), 2U);
}

TEST_F(CameraViewTest, ImagesThatCannotBeReadAreRefused) {
  view_.handleCameraInfo(cameraInfo());
  mountCamera(kStart);
  mountCamera(kStart + 1.0);
  view_.handleTracks(tracks(kStart + 1.0, 12.0, 0.0));
  const auto disparity = image(kStart);
  disparity->encoding = "32FC1";
  EXPECT_FALSE(show(disparity));
  const auto cut = image(kStart + 0.1);
  cut->data.resize(10);
  EXPECT_FALSE(show(cut));
  const auto unknown = image(kStart + 0.2);
  unknown->encoding = "no such";
  EXPECT_FALSE(show(unknown));
  EXPECT_EQ(drops(monitor_, "bad_encoding"), 3U);
  EXPECT_TRUE(show(image(kStart + 0.6))) << "the next one is shown";
}

TEST_F(CameraViewTest, AClockJumpBackStartsOver) {
  view_.handleCameraInfo(cameraInfo());
  mountCamera(kStart);
  view_.handleTracks(tracks(kStart, 12.0, 0.0));
  EXPECT_TRUE(show(image(kStart)));
  mountCamera(10.0);
  view_.handleTracks(tracks(10.0, 12.0, 0.0));
  const auto picture = show(image(10.0));
  ASSERT_TRUE(picture);
  EXPECT_TRUE(anyDrawn(*picture));
  EXPECT_EQ(warnings(monitor_, "clock_restart"), 1U);
}

TEST(CameraViewOptions, ValuesOutOfRangeAreRefused) {
  EXPECT_THROW(readOptions<CameraViewOptions>({{"line_width", 0}}), OptionError);
  EXPECT_THROW(readOptions<CameraViewOptions>({{"track_timeout", -1.0}}), OptionError);
}

}  // namespace
}  // namespace datmo::camera_view_test
