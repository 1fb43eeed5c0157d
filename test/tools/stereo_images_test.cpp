// SPDX-License-Identifier: BSD-3-Clause
// Clouds of image pairs: a wall whose distance is known, and invalid image pairs.
#include "run_bag/stereo_images.h"

#include <cmath>
#include <functional>
#include <limits>

#include "stereo_pair_sample.h"
#include <gtest/gtest.h>
#include <stereo_image_proc/DisparityConfig.h>

#include <sensor_msgs/point_cloud2_iterator.h>

namespace datmo::stereo_images_test {
namespace {

using sensor_msgs::PointCloud2Ptr;

const Stamp kStart = Stamp::fromSeconds(100.0);

StereoImagesOptions semiGlobal() {
  StereoImagesOptions options;
  options.stereo_algorithm = 1;
  options.disparity_range = 32;
  return options;
}

struct WallSeen {
  std::size_t points = 0;  ///< with a depth
  double worst = 0.0;      ///< m, error of depth
};

WallSeen look(const sensor_msgs::PointCloud2& cloud, double depth) {
  WallSeen seen;
  for (sensor_msgs::PointCloud2ConstIterator<float> z(cloud, "z"); z != z.end(); ++z) {
    if (std::isfinite(*z)) {
      ++seen.points;
      seen.worst = std::max(seen.worst, std::abs(*z - depth));
    }
  }
  return seen;
}

StereoImagesOptions unrectified(StereoImagesOptions options) {
  options.rectified = false;
  return options;
}

class StereoImagesTest : public testing::Test {
 protected:
  using Change = std::function<void(sensor_msgs::Image&, sensor_msgs::CameraInfo&)>;

  /// Takes a pair, the right camera first; `change`: of the right camera's messages.
  PointCloud2Ptr take(StereoImages& stage, Stamp stamp, const std::string& encoding = "mono8",
                      const Change& change = nullptr) const {
    const auto image = sample_.image(stamp, true, encoding);
    const auto info = sample_.info(stamp, true);
    if (change) {
      change(*image, *info);
    }
    stage.handleImage(StereoSide::kRight, image);
    stage.handleInfo(StereoSide::kRight, info);
    stage.handleImage(StereoSide::kLeft, sample_.image(stamp, false, encoding));
    return stage.handleInfo(StereoSide::kLeft, sample_.info(stamp, false));
  }

  /// Expects that the pair is dropped for this reason, and the next one is processed.
  void expectDrop(const std::string& reason, const Change& change) const {
    StageMonitor monitor("stereo_images");
    StereoImages stage(semiGlobal(), monitor);
    EXPECT_FALSE(take(stage, kStart, "mono8", change)) << reason;
    EXPECT_EQ(monitor.drops().count(reason), 1U) << reason << ": " << monitor.lastError();
    EXPECT_TRUE(take(stage, kStart + 0.1)) << reason;
  }

  StereoPairSample sample_;
};

TEST_F(StereoImagesTest, WallIsAtItsDistance) {
  for (const int algorithm : {0, 1}) {
    StereoImagesOptions options = semiGlobal();
    options.stereo_algorithm = algorithm;
    StageMonitor monitor("stereo_images");
    StereoImages stage(options, monitor);
    const PointCloud2Ptr cloud = take(stage, kStart);
    ASSERT_TRUE(cloud);
    EXPECT_EQ(cloud->header.frame_id, sample_.frame);
    EXPECT_EQ(toStamp(cloud->header.stamp), kStart);
    EXPECT_EQ(cloud->width * cloud->height, 160U * 120U);
    const WallSeen seen = look(*cloud, sample_.depth());
    EXPECT_GT(seen.points, 160U * 120U / 2U) << "algorithm " << algorithm;
    // The textures match exactly: only the interpolation between pixels adds an error.
    EXPECT_LT(seen.worst, 0.05 * sample_.depth()) << "algorithm " << algorithm;
    EXPECT_EQ(monitor.processedCount(), 1U);
  }
}

TEST_F(StereoImagesTest, ColorsAndRawImagesGiveTheSamePoints) {
  StageMonitor monitor("stereo_images");
  StereoImages rectified(semiGlobal(), monitor);
  StereoImages raw(unrectified(semiGlobal()), monitor);
  const PointCloud2Ptr gray = take(rectified, kStart);
  ASSERT_TRUE(gray);
  for (const char* encoding : {"rgb8", "bgr8"}) {
    const PointCloud2Ptr colored =
        take(rectified, kStart + (encoding[0] == 'r' ? 0.1 : 0.2), encoding);
    ASSERT_TRUE(colored) << encoding;
    EXPECT_EQ(colored->data, gray->data) << encoding;
  }
  const PointCloud2Ptr from_raw = take(raw, kStart);
  ASSERT_TRUE(from_raw);
  EXPECT_EQ(from_raw->data, gray->data) << "there is no distortion to take away";
}

TEST_F(StereoImagesTest, RawImagesAreRectified) {
  StageMonitor monitor("stereo_images");
  StereoImages stage(unrectified(semiGlobal()), monitor);
  const double shift = 4.0;  // px: the raw right image lies that much further to the right
  const auto cloud = take(stage, kStart, "mono8", [&](const auto& /*image*/, auto& info) {
    info.K[2] -= shift;
    info.D[0] = 1e-9;  // otherwise the library takes the image as it is
  });
  ASSERT_TRUE(cloud);
  StereoPairSample nearer = sample_;
  nearer.disparity -= static_cast<int>(shift);
  EXPECT_LT(look(*cloud, nearer.depth()).worst, 0.1 * nearer.depth());
}

TEST_F(StereoImagesTest, SameImagesGiveTheSameBytes) {
  StageMonitor monitor("stereo_images");
  StereoImages one(semiGlobal(), monitor);
  StereoImages other(semiGlobal(), monitor);
  take(one, kStart);
  EXPECT_EQ(take(one, kStart + 0.1)->data, take(other, kStart)->data);
}

TEST_F(StereoImagesTest, InvalidImagesAreDropped) {
  expectDrop("bad_encoding", [](auto& image, auto&) { image.encoding = "16UC1"; });
  expectDrop("wrong_size", [](auto& image, auto&) { image.data.pop_back(); });
  expectDrop("wrong_size", [](auto& image, auto&) { image.width = 0; });
  expectDrop("wrong_size", [](auto& image, auto&) { image.step = 1; });
  expectDrop("zero_stamp", [](auto& image, auto&) { image.header.stamp = ros::Time(); });
}

TEST_F(StereoImagesTest, InvalidCalibrationsAreDropped) {
  expectDrop("wrong_size", [](auto&, auto& info) { info.width += 1; });
  expectDrop("wrong_size", [](auto& image, auto& info) {
    image.height = info.height /= 2;
    image.data.resize(image.data.size() / 2);
  });
  expectDrop("bad_calibration", [](auto&, auto& info) { info.binning_x = 2; });
  expectDrop("bad_calibration", [](auto&, auto& info) { info.roi.y_offset = 8; });
  expectDrop("bad_calibration", [](auto&, auto& info) { info.K[0] = 0.0; });
  expectDrop("bad_calibration", [](auto&, auto& info) { info.P[0] += 1.0; });
  expectDrop("bad_calibration", [](auto&, auto& info) { info.P[3] = 0.0; });
  expectDrop("bad_calibration",
             [](auto&, auto& info) { info.P[3] = std::numeric_limits<double>::quiet_NaN(); });
  expectDrop("unknown_frame", [](auto&, auto& info) { info.header.frame_id = "right_camera"; });
}

TEST_F(StereoImagesTest, ImagesSmallerThanTheSearchGiveNoPointsOrAreDropped) {
  sample_.width = 16;
  sample_.height = 8;
  for (const int algorithm : {0, 1}) {
    StereoImagesOptions options;
    options.stereo_algorithm = algorithm;
    options.disparity_range = 64;
    StageMonitor monitor("stereo_images");
    StereoImages stage(options, monitor);
    const PointCloud2Ptr cloud = take(stage, kStart);
    EXPECT_EQ(cloud ? look(*cloud, 0.0).points : 0U, 0U) << "algorithm " << algorithm;
  }
}

TEST_F(StereoImagesTest, StampsOfTheTwoCamerasMayDifferOnRequest) {
  const auto late = [](auto& image, auto& info) {
    image.header.stamp = info.header.stamp = toTime(kStart + 0.003);
  };
  StageMonitor monitor("stereo_images");
  StereoImages exact(semiGlobal(), monitor);
  EXPECT_FALSE(take(exact, kStart, "mono8", late));
  StereoImagesOptions options = semiGlobal();
  options.sync.approximate_sync = true;
  StereoImages approximate(options, monitor);
  EXPECT_TRUE(take(approximate, kStart, "mono8", late));
}

TEST_F(StereoImagesTest, LoopedBagStartsOver) {
  StageMonitor monitor("stereo_images");
  StereoImages stage(semiGlobal(), monitor);
  EXPECT_TRUE(take(stage, kStart + 60.0));
  EXPECT_TRUE(take(stage, kStart));
}

TEST_F(StereoImagesTest, ImagesWithoutPartnerAreCounted) {
  StageMonitor monitor("stereo_images");
  StereoImages stage(semiGlobal(), monitor);
  stage.handleImage(StereoSide::kLeft, sample_.image(kStart, false, "mono8"));
  EXPECT_TRUE(take(stage, kStart + 0.1));
  EXPECT_EQ(monitor.warnings().at("unpaired_image"), 1U);
}

TEST(StereoImagesOptionsTest, DefaultsAreTheNodelets) {
  const auto nodelet = stereo_image_proc::DisparityConfig::__getDefault__();
  const StereoImagesOptions ours;
  EXPECT_EQ(ours.stereo_algorithm, nodelet.stereo_algorithm);
  EXPECT_EQ(ours.prefilter_size, nodelet.prefilter_size);
  EXPECT_EQ(ours.prefilter_cap, nodelet.prefilter_cap);
  EXPECT_EQ(ours.correlation_window_size, nodelet.correlation_window_size);
  EXPECT_EQ(ours.min_disparity, nodelet.min_disparity);
  EXPECT_EQ(ours.disparity_range, nodelet.disparity_range);
  EXPECT_EQ(ours.uniqueness_ratio, nodelet.uniqueness_ratio);
  EXPECT_EQ(ours.texture_threshold, nodelet.texture_threshold);
  EXPECT_EQ(ours.speckle_size, nodelet.speckle_size);
  EXPECT_EQ(ours.speckle_range, nodelet.speckle_range);
  EXPECT_EQ(ours.full_dp, nodelet.fullDP);
  EXPECT_EQ(ours.small_change_price, nodelet.P1);
  EXPECT_EQ(ours.large_change_price, nodelet.P2);
  EXPECT_EQ(ours.left_right_difference, nodelet.disp12MaxDiff);
}

}  // namespace
}  // namespace datmo::stereo_images_test
