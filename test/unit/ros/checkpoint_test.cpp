// SPDX-License-Identifier: BSD-3-Clause
// When the SLAM continues from a checkpoint, and when it begins a new map.
#include <filesystem>
#include <string>

#include "checkpoint_fixture.h"
#include <gtest/gtest.h>

namespace datmo::checkpoint_test {
namespace {

TEST_F(CheckpointTest, KilledAtRestItIsFoundInItsMap) {
  drive(35);
  twist_ = {};
  drive(20);
  kill();
  go(1.5);
  load();
  const GridSlamOutput first = drive(1);
  EXPECT_EQ(first.localization->state, LocalizationState::UNCERTAIN);
  EXPECT_NEAR(monitor_->figures().at("age of the checkpoint at the start [s]"), 1.6, 1e-6);
  const GridSlamOutput last = drive(40);
  EXPECT_EQ(last.localization->state, LocalizationState::LOCATED);
  EXPECT_EQ(last.localization->maps_started, 0U);
  EXPECT_LT(errorOf(last), 0.15);
}

TEST_F(CheckpointTest, KilledWhileDrivingItSoonContinuesInTheSameFrame) {
  drive(35);
  kill();
  go(1.5);
  load();
  EXPECT_EQ(drive(1).localization->state, LocalizationState::UNCERTAIN);
  const GridSlamOutput last = drive(10);
  EXPECT_EQ(last.localization->state, LocalizationState::LOCATED);
  EXPECT_EQ(last.localization->maps_started, 1U);
  EXPECT_LT(errorOf(last), 0.5);
}

TEST_F(CheckpointTest, UnloadedItContinuesWithoutASearch) {
  driveAndUnload();
  go(0.2);
  load();
  const GridSlamOutput first = drive(1);
  EXPECT_EQ(first.localization->state, LocalizationState::LOCATED);
  EXPECT_LT(errorOf(first), 0.15);
  EXPECT_NE(monitor_->healthReason().find("continues from a checkpoint of 0.3 s"),
            std::string::npos);
}

TEST_F(CheckpointTest, AnotherStartOfTheStackBeginsANewMap) {
  driveAndUnload();
  options_.checkpoint.run = "run 2";
  load();
  EXPECT_TRUE(startsAnew());
}

TEST_F(CheckpointTest, AnOldCheckpointIsIgnored) {
  driveAndUnload();
  go(12.0);
  expectNewMap("12.1 s before the first scan, expected more than 0 and at most 10 s");
}

TEST_F(CheckpointTest, ABagThatStartsAgainBeginsANewMap) {
  driveAndUnload();
  now_ -= 3.0;
  expectNewMap("its pose is from -2.9 s before");
}

TEST_F(CheckpointTest, AfterAJumpOfTheClockThereIsNoWayBack) {
  driveAndUnload();
  load();
  drive(1);
  now_ -= 50.0;
  EXPECT_TRUE(startsAnew());
  EXPECT_FALSE(std::filesystem::exists(file())) << "by the new clock, it may look recent";
}

TEST_F(CheckpointTest, AnotherConfigurationBeginsANewMap) {
  driveAndUnload();
  options_.slam.map.window.cell_size = 0.2;
  expectNewMap("map/cell_size was 0.3, expected 0.2");
}

TEST_F(CheckpointTest, OnABagNothingIsWrittenOrRead) {
  driveAndUnload();
  const std::string before = contentOf(file());
  load({});
  EXPECT_TRUE(startsAnew());
  drive(30);
  unload();
  EXPECT_EQ(contentOf(file()), before);
}

}  // namespace
}  // namespace datmo::checkpoint_test
