// SPDX-License-Identifier: BSD-3-Clause
// The bag runner with a camera that classifies objects: the small drive with images of a wall.
#include "stereo_drive.h"
#include <gtest/gtest.h>

namespace datmo::run_bag_mono_test {
namespace {

class MonoRun : public StereoRunBag {
 protected:
  MonoRun() { arguments_.mono = true; }

  /// Images of the left camera alone; each differs from the last in a pixel, as it is not frozen.
  void appendLeftImages() const {
    std::uint8_t number = 0;
    append([&](rosbag::Bag& bag, Stamp stamp) {
      const auto image = sample_.image(stamp, false, "mono8");
      image->data[0] = ++number;
      bag.write("/stereo/left/image_rect", toTime(stamp), *image);
      bag.write("/stereo/left/camera_info", toTime(stamp), sample_.info(stamp, false));
    });
  }
};

TEST_F(MonoRun, EveryImageLeadsToAListThatIsFused) {
  appendLeftImages();
  const std::string table = run();
  EXPECT_EQ(count(arguments_.output, "/objects/mono"), kCloudCount) << table;
  EXPECT_GT(count(arguments_.output, "/objects/classes"), 0U) << table;
  EXPECT_EQ(count(arguments_.output, "/objects/fused"), kScanCount);
  EXPECT_EQ(count(arguments_.output, "/objects/stereo"), 0U) << "there is no right camera";
  EXPECT_EQ(count(arguments_.output, "/tracks"), kScanCount);
  const auto lists = listsOf<ObjectArray>("/objects/mono");
  for (int i = 0; i < kStereoClouds; ++i) {
    EXPECT_EQ(lists[static_cast<std::size_t>(i)].header.stamp, toTime(kStart + i * kCloudPeriod));
  }
}

TEST_F(MonoRun, SameBagGivesTheSameBytes) {
  appendLeftImages();
  run();
  const std::string first = bytes(arguments_.output);
  run();
  EXPECT_EQ(first, bytes(arguments_.output));
}

TEST_F(MonoRun, WithAStereoCameraTheImagesAreUsedByBoth) {
  appendImages();
  arguments_.object_fusion = true;
  const std::string table = run();
  EXPECT_EQ(count(arguments_.output, "/objects/stereo"), kCloudCount);
  EXPECT_EQ(count(arguments_.output, "/objects/mono"), 1U);
  EXPECT_TRUE(holds(table, "frozen_image")) << "they are all the same; " << table;
}

TEST_F(MonoRun, MissingImagesAreNamed) {
  const std::string message = failure();
  EXPECT_TRUE(holds(message, "/stereo/left/image_rect")) << message;
  EXPECT_TRUE(holds(message, "--mono")) << message;
}

TEST(MonoArguments, AreRead) {
  const std::vector<std::string> files = {"a.bag", "b.bag", "--config", "c.yaml", "--mono"};
  EXPECT_TRUE(parseArguments(files).mono);
  std::vector<std::string> words = files;
  words.insert(words.end(), {"--until", "object_fusion"});
  EXPECT_EQ(parseArguments(words).last_stage, LastStage::kObjectFusion);
  words.back() = "moving_objects";
  EXPECT_THROW(parseArguments(words), UsageError);
}

}  // namespace
}  // namespace datmo::run_bag_mono_test
