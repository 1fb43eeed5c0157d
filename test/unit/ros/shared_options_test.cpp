// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/shared_options.h"

#include <gtest/gtest.h>

#include "datmo_fusion/common/angle.h"
#include "datmo_fusion/ros/stage/grid_slam_stage.h"
#include "datmo_fusion/ros/stage/tracker_stage.h"

namespace datmo::shared_options_test {
namespace {

/// The message of the OptionError that `read` throws; empty if it throws none.
template <typename Read>
std::string errorOf(const Read& read) {
  try {
    read();
  } catch (const OptionError& error) {
    return error.what();
  }
  return "";
}

void expectMentions(const std::string& message, const std::vector<std::string>& parts) {
  for (const std::string& part : parts) {
    EXPECT_NE(message.find(part), std::string::npos) << part << " not in: " << message;
  }
}

TEST(SharedOptions, FramesAreNamedOnceAndHonoredByEachStage) {
  const SharedOptions shared =
      readSharedOptions({{"odom", std::string("/wheels")}, {"base", std::string("robot")}}, {}, {});
  const auto slam = readStageOptions<GridSlamStageOptions>({}, shared);
  EXPECT_EQ(slam.frames.odom, "wheels") << "without the slash";
  EXPECT_EQ(slam.frames.base, "robot");
  EXPECT_EQ(slam.frames.map, "map") << "the default";
  EXPECT_EQ(readStageOptions<TrackerStageOptions>({}, shared).frames.base, "robot");
}

TEST(SharedOptions, UnknownKeysAndBadFramesAreNamedWithTheirSection) {
  expectMentions(errorOf([] {
                   readSharedOptions({{"bse", std::string("robot")}}, {}, {});
                 }),
                 {"frames", "bse", "base"});
  expectMentions(errorOf([] {
                   readSharedOptions({{"base", std::string("odom")}}, {}, {});
                 }),
                 {"frames", "odom", "three different names"});
  expectMentions(errorOf([] {
                   readSharedOptions({{"map", std::string("")}}, {}, {});
                 }),
                 {"frames", "three different names"});
  expectMentions(errorOf([] {
                   readSharedOptions({}, {}, {{"source", std::string("gps")}});
                 }),
                 {"motion", "source", "gps", "imu_and_twist"});
}

TEST(SharedOptions, MovedKeysAreRefusedWithTheNewOne) {
  const auto errorOfKey = [](const std::string& key, const OptionValue& value) {
    return errorOf([&] { readStageOptions<GridSlamStageOptions>({{key, value}}, {}); });
  };
  expectMentions(errorOfKey("base_frame", std::string("robot")),
                 {"base_frame = 'robot'", "frames: {base: ...}"});
  expectMentions(errorOfKey("fixed_frame", std::string("odom")), {"frames: {map: ...}"});
  expectMentions(errorOfKey("odometry", false), {"motion: {source: "});
  expectMentions(errorOfKey("odometry_hold", 2.0), {"motion: {hold: ...}"});
}

TEST(Mounts, AreReadByFrame) {
  const Mounts mounts = readMounts({{"laser/x", 1.0},
                                    {"laser/yaw", 0.5},
                                    {"robot1/imu/roll", kPi},
                                    {"/camera/z", 1},
                                    {"/camera/pitch", -0.1}});
  ASSERT_EQ(mounts.size(), 3U);
  EXPECT_EQ(mounts.at("laser").x, 1.0);
  EXPECT_EQ(mounts.at("laser").yaw, 0.5);
  EXPECT_EQ(mounts.at("robot1/imu").roll, kPi) << "a frame with a slash in its name";
  EXPECT_EQ(mounts.at("camera").z, 1.0) << "one with a slash at its front";
}

TEST(Mounts, BadOnesAreNamed) {
  expectMentions(errorOf([] { readMounts({{"laser/hight", 1.0}}); }), {"laser", "hight"});
  expectMentions(errorOf([] { readMounts({{"laser/yaw", 90.0}}); }), {"laser", "yaw", "90", "rad"});
  expectMentions(errorOf([] { readMounts({{"laser/x", std::nan("")}}); }), {"laser", "x", "nan"});
  expectMentions(errorOf([] { readMounts({{"x", 1.0}}); }), {"x", "laser: {x: 1.0"});
}

TEST(Mounts, TurnAsRollPitchYawAboutFixedAxes) {
  MountOptions optical;  // of a camera that looks ahead
  optical.roll = -kPi / 2.0;
  optical.yaw = -kPi / 2.0;
  const auto message = toMessage({{"camera", optical}}, "base_link");
  ASSERT_EQ(message.transforms.size(), 1U);
  EXPECT_EQ(message.transforms[0].header.frame_id, "base_link");
  EXPECT_EQ(message.transforms[0].child_frame_id, "camera");
  const auto& q = message.transforms[0].transform.rotation;
  const Eigen::Vector3d ahead = Eigen::Quaterniond(q.w, q.x, q.y, q.z) * Eigen::Vector3d::UnitZ();
  EXPECT_NEAR((ahead - Eigen::Vector3d::UnitX()).norm(), 0.0, 1e-9) << "its z looks ahead";
}

}  // namespace
}  // namespace datmo::shared_options_test
