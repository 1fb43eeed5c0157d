// SPDX-License-Identifier: BSD-3-Clause
// The file of a checkpoint: what is written and read, damaged files, and files of others.
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>
#include <thread>
#include <vector>

#include "checkpoint_fixture.h"
#include <gtest/gtest.h>
#include <unistd.h>

#include "datmo_fusion/ros/map_format.h"

namespace datmo::checkpoint_test {
namespace {

TEST_F(CheckpointTest, WhatIsWrittenIsRead) {
  driveAndUnload();
  const Checkpoint read = readCheckpoint(file(), kMaxCells);
  EXPECT_EQ(read.run, "run 1");
  EXPECT_EQ(read.options.at("map/cell_size"), "0.3");
  EXPECT_EQ(read.slam.pose.odometry.size(), 1U);
  const std::string again = file("again");
  writeCheckpoint(again, read);
  EXPECT_EQ(contentOf(again), contentOf(file()));
}

TEST_F(CheckpointTest, APoseOfAnotherMapIsIgnored) {
  driveAndUnload();
  Checkpoint read = readCheckpoint(file(), kMaxCells);
  const Pose2 pose = read.slam.pose.estimate.pose;
  read.slam.pose.estimate.pose = Pose2(50.0, 0.0, 0.0);
  const std::uint32_t id = writeCheckpoint(file("again"), readCheckpoint(file(), kMaxCells));
  writePose(file(), id + 1, read.slam);
  EXPECT_EQ(readCheckpoint(file(), kMaxCells).slam.pose.estimate.pose.position(), pose.position());
  writePose(file(), id, read.slam);
  EXPECT_EQ(readCheckpoint(file(), kMaxCells).slam.pose.estimate.pose.x(), 50.0);
}

TEST_F(CheckpointTest, APoseThatNoVehicleCanHaveIsIgnored) {
  driveAndUnload();
  const Checkpoint read = readCheckpoint(file(), kMaxCells);
  const std::uint32_t id = writeCheckpoint(file(), read);
  SlamState later = read.slam;
  later.pose.estimate.pose = Pose2(1e12, 0.0, 0.0);
  writePose(file(), id, later);
  EXPECT_EQ(readCheckpoint(file(), kMaxCells).slam.pose.estimate.pose.position(),
            read.slam.pose.estimate.pose.position());
  later.pose.estimate.pose = Pose2(50.0, 0.0, 0.0);
  writePose(file(), id, later);
  EXPECT_EQ(readCheckpoint(file(), kMaxCells).slam.pose.estimate.pose.x(), 50.0);
}

TEST_F(CheckpointTest, AStateAfterALongSilenceOfTheScannerIsRead) {
  driveAndUnload();
  Checkpoint read = readCheckpoint(file(), kMaxCells);
  read.slam.pose.scan_interval = 60.0;  // after ten minutes
  removeCheckpoint(file());
  writeCheckpoint(file(), read);
  EXPECT_EQ(readCheckpoint(file(), kMaxCells).slam.pose.scan_interval, 60.0);
}

TEST_F(CheckpointTest, ADamagedFileIsOneWarningAndANewMap) {
  driveAndUnload();
  const std::string whole = contentOf(file());
  std::vector<std::string> damaged{"", "something else", std::string(10'000'000, 'x')};
  for (const double share : {0.0001, 0.001, 0.01, 0.5, 0.99}) {
    const auto length = static_cast<std::size_t>(share * static_cast<double>(whole.size()));
    damaged.push_back(whole.substr(0, length));
    damaged.push_back(whole);
    damaged.back()[length] ^= 0x20;
  }
  for (const std::string& content : damaged) {
    writeContent(file(), content);
    load();
    EXPECT_EQ(samples::warnings(*monitor_, "bad_checkpoint"), 1U) << content.substr(0, 60);
    EXPECT_TRUE(startsAnew());
    unload();
  }
}

TEST_F(CheckpointTest, AStateThatNoVehicleCanHaveIsOneWarningAndANewMap) {
  driveAndUnload();
  const Checkpoint sound = readCheckpoint(file(), kMaxCells);
  std::vector<Checkpoint> wrong(8, sound);
  wrong[0].slam.pose.scan_interval = 0.0;
  wrong[1].slam.pose.estimate.pose = Pose2(1e12, 0.0, 0.0);
  wrong[2].slam.pose.estimate.covariance(0, 0) = -1.0;
  wrong[3].slam.pose.estimate.velocity.forward_speed = 1e6;
  wrong[4].slam.pose.odometry = {sound.slam.pose.odometry.front(),
                                 sound.slam.pose.odometry.front()};
  wrong[4].slam.pose.odometry.front().stamp = wrong[4].slam.pose.odometry.back().stamp + 1.0;
  wrong[5].slam.map.frame(0, 1) = 1.0;
  // No ROS time; from here to any scan is more than an integer of nanoseconds holds.
  wrong[6].slam.pose.stamp = {std::numeric_limits<std::int64_t>::min()};
  wrong[7].slam.pose.odometry.front().stamp = {std::numeric_limits<std::int64_t>::min()};
  for (const Checkpoint& checkpoint : wrong) {
    removeCheckpoint(file());
    writeCheckpoint(file(), checkpoint);
    load();
    EXPECT_EQ(samples::warnings(*monitor_, "bad_checkpoint"), 1U);
    EXPECT_TRUE(startsAnew());
    unload();
  }
}

TEST_F(CheckpointTest, AFileOfAnotherUserIsOneWarningAndANewMap) {
  driveAndUnload();
  if (chown(file().c_str(), geteuid() + 1, getegid()) != 0) {
    GTEST_SKIP() << "only root can give a file to another user";
  }
  load();
  EXPECT_EQ(samples::warnings(*monitor_, "bad_checkpoint"), 1U);
  EXPECT_TRUE(startsAnew());
}

TEST_F(CheckpointTest, ALinkInPlaceOfTheCheckpointIsNotRead) {
  driveAndUnload();
  std::filesystem::rename(file(), file("other"));
  std::filesystem::create_symlink(file("other"), file());
  EXPECT_NO_THROW(readCheckpoint(file("other"), kMaxCells));
  EXPECT_THROW(readCheckpoint(file(), kMaxCells), MapFileError);
}

TEST_F(CheckpointTest, ALinkInPlaceOfTheUnfinishedFileIsNotFollowed) {
  const std::string other = file("other");
  writeContent(other, "of someone else");
  std::filesystem::create_symlink(other, file() + ".part");
  driveAndUnload();
  EXPECT_EQ(contentOf(other), "of someone else");
  EXPECT_TRUE(std::filesystem::is_regular_file(std::filesystem::symlink_status(file())));
  EXPECT_FALSE(std::filesystem::exists(file() + ".part"));
}

TEST_F(CheckpointTest, AFolderThatCannotBeWrittenIsOnlyAWarning) {
  options_.checkpoint.file = file("none/grid_slam.checkpoint");
  load();
  for (int i = 0; i < 200 && samples::warnings(*monitor_, "checkpoint_not_written") == 0; ++i) {
    drive(1);
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  EXPECT_GE(samples::warnings(*monitor_, "checkpoint_not_written"), 1U);
}

TEST_F(CheckpointTest, ALastStateThatCannotBeWrittenIsAWarning) {
  drive(35);
  waitForCheckpoint();
  ASSERT_EQ(samples::warnings(*monitor_, "checkpoint_not_written"), 0U);
  const std::string folder = std::filesystem::path(file()).parent_path();
  std::filesystem::rename(folder, folder + ".away");
  unload();
  EXPECT_GE(samples::warnings(*monitor_, "checkpoint_not_written"), 1U);
  std::filesystem::remove_all(folder + ".away");
}

}  // namespace
}  // namespace datmo::checkpoint_test
