// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/stage/object_fusion_stage.h"

#include <string>
#include <vector>

#include "object_fusion_sample.h"
#include <gtest/gtest.h>

namespace datmo::object_fusion_stage_test {
namespace {

TEST_F(ObjectFusionStageTest, ListsOfTheSameStampAreFusedAtOnce) {
  handle("lidar", 100.0, 20.0);
  EXPECT_FALSE(nextAt(100.0)) << "the other one may still come";
  handle("stereo", 100.0, 20.2);
  const auto fused = nextAt(100.0);
  ASSERT_TRUE(fused);
  EXPECT_EQ(fused->header.frame_id, "base_link");
  EXPECT_EQ(fused->header.stamp, ros::Time(100.0));
  ASSERT_EQ(sensorsOf(*fused), (std::vector<Sensors>{{"lidar", "stereo"}}));
  EXPECT_NEAR(fused->objects[0].pose.position.x, 20.1, 0.01);
  EXPECT_FALSE(nextAt(100.0));
  EXPECT_EQ(monitor_.processedCount(), 1U);
  EXPECT_EQ(monitor_.droppedCount() + monitor_.warningCount(), 0U);
  EXPECT_EQ(figure("objects of two or more sources"), 1.0);
}

class RetroactiveFusionTest : public ObjectFusionStageTest {
 protected:
  RetroactiveFusionTest() : ObjectFusionStageTest(retroactive()) {}

 private:
  static ObjectFusionStageOptions retroactive() {
    ObjectFusionStageOptions options;
    options.retroactive = true;
    return options;
  }
};

TEST_F(RetroactiveFusionTest, WaitingListsArePublishedEarlyOnce) {
  handle("lidar", 100.0, 20.0);
  const auto early = stage_.nextEarly(Stamp::fromSeconds(100.0));
  ASSERT_TRUE(early);
  EXPECT_EQ(early->header.stamp, ros::Time(100.0));
  EXPECT_EQ(early->header.frame_id, "base_link");
  EXPECT_EQ(sensorsOf(*early), std::vector<Sensors>{{"lidar"}});
  EXPECT_FALSE(stage_.nextEarly(Stamp::fromSeconds(100.0)));
  EXPECT_EQ(monitor_.processedCount(), 0U) << "it is yet to be fused";
  handle("stereo", 100.0, 20.2);
  ASSERT_TRUE(nextAt(100.0));
  handle("lidar", 100.1);
  handle("stereo", 100.1);
  ASSERT_TRUE(nextAt(100.1));
  EXPECT_FALSE(stage_.nextEarly(Stamp::fromSeconds(100.1))) << "it did not have to wait";
}

TEST_F(RetroactiveFusionTest, EarlyListsDoNotChangeTheFusedOnes) {
  StageMonitor other_monitor("object_fusion");
  ObjectFusionStage other(options_, other_monitor);
  for (int i = 0; i < 20; ++i) {
    const double t = 100.0 + 0.1 * i;
    const ObjectArray lidar = list(t, {car("lidar", 20.0 + i, 0.0)});
    const ObjectArray stereo = list(t, {car("stereo", 20.2 + i, 0.0), car("stereo", 9.0, 9.0)});
    LabeledScan scan;
    scan.stamp = Stamp::fromSeconds(t);
    for (ObjectFusionStage* stage : {&stage_, &other}) {
      stage->handleLabeledScan(toMessage(scan, "base_link", "map"));
      stage->handleObjects("lidar", lidar, Stamp::fromSeconds(t));
    }
    EXPECT_TRUE(stage_.nextEarly(Stamp::fromSeconds(t)));
    handle("stereo", stereo);
    other.handleObjects("stereo", stereo, Stamp::fromSeconds(t));
    const auto fused = nextAt(t);
    const auto expected = other.next(Stamp::fromSeconds(t));
    ASSERT_TRUE(fused && expected);
    EXPECT_EQ(*fused, *expected) << i;
  }
  EXPECT_EQ(figure("fused without a labeled scan"), 0.0) << "the early one has not used it up";
}

TEST_F(ObjectFusionStageTest, IfAllWaitNoneIsEarly) {
  handle("lidar", 100.0, 20.0);
  EXPECT_FALSE(stage_.nextEarly(Stamp::fromSeconds(100.0)));
  EXPECT_TRUE(nextAt(100.2));
}

TEST_F(ObjectFusionStageTest, ObjectsOfOneSourceAreKept) {
  handle("lidar", 100.0, 20.0, 0.0);
  handle("stereo", 100.0, 20.0, 15.0);
  const auto fused = nextAt(100.0);
  ASSERT_TRUE(fused);
  EXPECT_EQ(sensorsOf(*fused), (std::vector<Sensors>{{"lidar"}, {"stereo"}}));
  EXPECT_EQ(figure("objects of two or more sources"), 0.0);
}

TEST_F(ObjectFusionStageTest, AnEmptyListIsOneToo) {
  handle("lidar", list(100.0, {}));
  handle("stereo", list(100.0, {}));
  const auto fused = nextAt(100.0);
  ASSERT_TRUE(fused) << "the tracker is to hear that nothing was seen";
  EXPECT_TRUE(fused->objects.empty());
}

TEST_F(ObjectFusionStageTest, AListIsFusedOnce) {
  stage_.handleOdometry(odometry(100.0));
  handle("lidar", 100.0);
  handle("stereo", 100.02);
  ASSERT_EQ(nextAt(100.02)->objects.size(), 1U);
  handle("lidar", 100.06);
  const auto fused = nextAt(100.2);
  ASSERT_TRUE(fused);
  EXPECT_EQ(sensorsOf(*fused), std::vector<Sensors>{{"lidar"}});
  EXPECT_EQ(figure("fused without stereo"), 1.0);
  EXPECT_EQ(monitor_.warningCount(), 0U) << "it is slower, that is all";
}

TEST_F(ObjectFusionStageTest, ListsThatAreNotFusedAreCounted) {
  for (const double seconds : {100.0, 100.02, 100.04, 100.06, 100.08, 100.1}) {
    handle("stereo", seconds);
  }
  handle("lidar", 100.1);
  ASSERT_TRUE(nextAt(100.1));
  EXPECT_EQ(figure("lists of stereo not fused"), 5.0);
  EXPECT_EQ(figure("lists of lidar not fused"), 0.0);
}

TEST_F(ObjectFusionStageTest, ObjectsAreMovedByTheOdometryBetweenTheirStamps) {
  stage_.handleOdometry(odometry(99.9));
  stage_.handleOdometry(odometry(100.0));
  handle("stereo", 99.95, 20.0, 15.0);
  handle("lidar", list(100.0, {}));
  const auto fused = nextAt(100.2);
  ASSERT_TRUE(fused);
  ASSERT_EQ(fused->objects.size(), 1U);
  EXPECT_NEAR(fused->objects[0].pose.position.x, 19.0, 0.01) << "after 0.05 s at 20 m/s";
  EXPECT_NEAR(fused->objects[0].delay, -0.05, 1e-6);
}

TEST_F(ObjectFusionStageTest, WithoutOdometryTheyAreMovedByThePosesOfTheSlam) {
  options_.motion.source = MotionSource::kNone;
  ObjectFusionStage stage(options_, monitor_);
  stage.handleOdometry(odometry(0.0));
  for (const double t : {99.7, 99.8, 99.9}) {
    geometry_msgs::PoseWithCovarianceStamped pose;
    pose.header.stamp = ros::Time(t);
    pose.pose.pose = toMessage(Pose2(20.0 * t, 5.0, 0.0));
    stage.handlePose(pose);
  }
  const Stamp now = Stamp::fromSeconds(100.0);
  stage.handleObjects("stereo", list(99.95, {car("stereo", 20.0, 15.0)}), now);
  stage.handleObjects("lidar", list(100.0, {}), now);
  const auto fused = stage.next(Stamp::fromSeconds(100.2));
  ASSERT_TRUE(fused);
  ASSERT_EQ(fused->objects.size(), 1U);
  EXPECT_NEAR(fused->objects[0].pose.position.x, 19.0, 0.01);
  EXPECT_EQ(monitor_.droppedCount(), 0U) << "odometry is not read";
}

TEST_F(ObjectFusionStageTest, AListOfUnknownMotionIsLeftOut) {
  for (int i = 0; i <= 10; ++i) {
    const double t = 100.0 + 0.1 * i;
    handle("stereo", t - 0.05);
    handle("lidar", t);
    const auto fused = nextAt(t + 0.1);
    ASSERT_TRUE(fused);
    EXPECT_EQ(sensorsOf(*fused), std::vector<Sensors>{{"lidar"}});
    if (i == 1) {
      EXPECT_EQ(monitor_.warningCount(), 0U) << "it may yet become known";
    }
  }
  EXPECT_EQ(figure("fused without stereo"), 11.0);
  EXPECT_EQ(warnings("no_motion"), 1U);
  EXPECT_EQ(monitor_.warningCount(), 1U);
}

TEST_F(ObjectFusionStageTest, ASilentSourceIsReportedOnceAndTheOthersContinue) {
  for (const std::string source : {"lidar", "stereo"}) {
    const double start = source == "lidar" ? 100.0 : 200.0;
    EXPECT_TRUE(bothAt(start));
    const std::uint64_t before = warnings("silent_source");
    int fused = 0;
    for (int i = 1; i < 20; ++i) {
      const double t = start + 0.1 * i;
      handle(source, t);
      while (const auto output = nextAt(t)) {
        ++fused;
        EXPECT_EQ(sensorsOf(*output), std::vector<Sensors>{{source}});
        EXPECT_TRUE(i < 10 || output->header.stamp == ros::Time(t)) << "it is not waited for";
      }
    }
    EXPECT_GE(fused, 17) << source;
    EXPECT_EQ(warnings("silent_source"), before + 1U);
    EXPECT_EQ(sensorsOf(*bothAt(start + 2.0)), (std::vector<Sensors>{{"lidar", "stereo"}}))
        << "it is back";
  }
  EXPECT_EQ(monitor_.warningCount(), 2U);
}

TEST_F(ObjectFusionStageTest, ASourceThatIsAlwaysTooLateIsReportedOnce) {
  for (int i = 0; i < 10; ++i) {
    const double t = 100.0 + 0.1 * i;
    handle("lidar", t);
    EXPECT_TRUE(nextAt(t + 0.11));
    handle("stereo", t - 0.15);
  }
  EXPECT_EQ(warnings("late_source"), 1U);
  EXPECT_EQ(monitor_.warningCount(), 1U);
  EXPECT_GT(figure("lists of stereo not fused"), 5.0);
}

}  // namespace
}  // namespace datmo::object_fusion_stage_test
