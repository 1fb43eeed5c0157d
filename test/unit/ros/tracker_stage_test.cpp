// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/stage/tracker_stage.h"

#include <algorithm>
#include <limits>

#include "message_samples.h"
#include <boost/make_shared.hpp>
#include <gtest/gtest.h>

#include "datmo_fusion/common/class_belief.h"
#include "datmo_fusion/ros/convert/message_conversion.h"

namespace datmo::tracker_stage_test {
namespace {

class TrackerStageTest : public testing::Test {
 protected:
  static ObjectArrayConstPtr emptyList(double seconds) {
    const auto message = boost::make_shared<ObjectArray>();
    message->header.stamp = ros::Time(seconds);
    message->header.frame_id = "base_link";
    return message;
  }

  void objectsAt(double seconds) {
    stage_.handleObjects(emptyList(seconds), Stamp::fromSeconds(seconds));
  }

  void earlyObjectsAt(double seconds) {
    stage_.handleEarlyObjects(emptyList(seconds), Stamp::fromSeconds(seconds));
  }

  void poseAt(double seconds) {
    buffer_.add(samples::transforms({samples::transform("map", "base_link", 0.0, seconds)}));
  }

  void scanPoseAt(double seconds, const std::string& map_frame = "map") {
    LabeledScan scan;
    scan.stamp = Stamp::fromSeconds(seconds);
    stage_.handleLabeledScan(toMessage(scan, "base_link", map_frame));
  }

  TrackArrayPtr nextAt(double seconds) { return stage_.next(Stamp::fromSeconds(seconds)); }

  TransformBuffer buffer_{1.0};
  StageMonitor monitor_{"tracker"};
  TrackerStage stage_{TrackerStageOptions(), buffer_, monitor_};
};

TEST_F(TrackerStageTest, ObjectsWaitForTheirTransform) {
  poseAt(99.9);
  objectsAt(100.0);
  EXPECT_FALSE(nextAt(100.1));
  poseAt(100.02);
  const auto tracks = nextAt(100.1);
  ASSERT_TRUE(tracks);
  EXPECT_EQ(tracks->header.stamp, ros::Time(100.0));
  EXPECT_EQ(tracks->header.frame_id, "map");
  EXPECT_FALSE(nextAt(100.1));
  EXPECT_EQ(monitor_.droppedCount(), 0U);
}

TEST_F(TrackerStageTest, ThePoseOfTheirScanIsUsedBeforeTf) {
  poseAt(99.9);
  objectsAt(100.0);
  scanPoseAt(99.94);
  EXPECT_FALSE(nextAt(100.0)) << "only the pose at their own stamp counts";
  scanPoseAt(100.0);
  const auto tracks = nextAt(100.0);
  ASSERT_TRUE(tracks);
  EXPECT_EQ(tracks->header.stamp, ros::Time(100.0));
}

TEST_F(TrackerStageTest, ThePoseOfTheirScanIsUsedOnlyInTheFrameOfTheTracks) {
  poseAt(99.9);
  objectsAt(100.0);
  scanPoseAt(100.0, "world");
  EXPECT_FALSE(nextAt(100.0));
}

TEST_F(TrackerStageTest, AScanOfARestartedClockForgetsAllTracksOnce) {
  poseAt(99.9);
  objectsAt(110.0);
  scanPoseAt(110.0);
  EXPECT_TRUE(nextAt(110.0));
  scanPoseAt(100.0);
  objectsAt(100.0);
  EXPECT_TRUE(nextAt(100.0));
  EXPECT_EQ(monitor_.warnings().at("clock_restart"), 1U);
}

TEST_F(TrackerStageTest, StaleOnesMakeRoomForTheNext) {
  objectsAt(100.0);
  objectsAt(100.1);
  scanPoseAt(100.1);
  poseAt(99.9);
  EXPECT_FALSE(nextAt(100.1)) << "the first waits";
  const auto tracks = nextAt(100.5);
  ASSERT_TRUE(tracks);
  EXPECT_EQ(tracks->header.stamp, ros::Time(100.1));
  EXPECT_EQ(monitor_.drops().at("missing_transform"), 1U);
}

TEST_F(TrackerStageTest, LiveOptionsAreListedAndChanged) {
  stage_.change({{"target/motion_likelihood/required_probability", 0.95}});
  const std::vector<LiveOption> live = stage_.live();
  const auto changed = std::find_if(live.begin(), live.end(), [](const LiveOption& option) {
    return option.key == "target/motion_likelihood/required_probability";
  });
  ASSERT_NE(changed, live.end());
  EXPECT_EQ(changed->value, OptionValue(0.95));
  EXPECT_THROW(stage_.change({{"published_existence", 2.0}}), OptionError);
  EXPECT_THROW(stage_.change({{"history_time", 1.0}}), OptionError) << "not live";
}

TEST_F(TrackerStageTest, ABadPoseOfAScanIsDropped) {
  LabeledScanMessage scan = toMessage(LabeledScan(), "base_link", "map");
  scan.pose.pose.orientation.w = std::numeric_limits<double>::quiet_NaN();
  stage_.handleLabeledScan(scan);
  EXPECT_EQ(monitor_.drops().at("bad_pose"), 1U);
}

TEST_F(TrackerStageTest, AfterTheLongestWaitTheyAreDroppedAndTheNextProcessed) {
  objectsAt(100.0);
  objectsAt(101.0);
  poseAt(100.9);
  poseAt(101.1);
  const auto tracks = nextAt(101.1);
  ASSERT_TRUE(tracks);
  EXPECT_EQ(tracks->header.stamp, ros::Time(101.0));
  EXPECT_EQ(monitor_.drops().at("missing_transform"), 1U);
}

TEST_F(TrackerStageTest, TheQueueIsBounded) {
  for (int i = 0; i < 200; ++i) {
    objectsAt(100.0 + 0.001 * i);
  }
  EXPECT_EQ(monitor_.drops().at("queue_full"), 150U);
}

TEST_F(TrackerStageTest, AJumpBackForgetsWaitingObjects) {
  objectsAt(110.0);
  objectsAt(100.0);
  poseAt(100.0);
  const auto tracks = nextAt(100.0);
  ASSERT_TRUE(tracks);
  EXPECT_EQ(tracks->header.stamp, ros::Time(100.0));
  EXPECT_EQ(monitor_.warnings().at("clock_restart"), 1U);
}

TEST_F(TrackerStageTest, TracksOfEarlyAndCompleteObjectsArePublishedOnce) {
  poseAt(99.9);
  poseAt(100.3);
  earlyObjectsAt(100.0);
  const auto early = nextAt(100.0);
  ASSERT_TRUE(early);
  EXPECT_EQ(early->header.stamp, ros::Time(100.0));
  earlyObjectsAt(100.06);
  ASSERT_TRUE(nextAt(100.06));
  objectsAt(100.0);
  EXPECT_FALSE(nextAt(100.1)) << "these tracks are out";
  objectsAt(100.06);
  objectsAt(100.12);
  const auto complete = nextAt(100.12);
  ASSERT_TRUE(complete) << "none of this time were early";
  EXPECT_EQ(complete->header.stamp, ros::Time(100.12));
  earlyObjectsAt(100.1);
  EXPECT_FALSE(nextAt(100.12)) << "too late to be early";
  EXPECT_EQ(monitor_.droppedCount() + monitor_.warningCount(), 0U);
}

TEST_F(TrackerStageTest, LateClassesNeedNotBeInOrderOfTheObjectsStamps) {
  poseAt(99.9);
  poseAt(100.3);
  for (const double seconds : {100.0, 100.06, 100.12}) {
    objectsAt(seconds);
    ASSERT_TRUE(nextAt(seconds));
  }
  stage_.handleClasses(*emptyList(100.0));
  objectsAt(100.18);
  EXPECT_TRUE(nextAt(100.18));
  EXPECT_EQ(monitor_.droppedCount() + monitor_.warningCount(), 0U);
}

TEST_F(TrackerStageTest, AClassReachesTheTrackOfItsObject) {
  TrackerStageOptions options;
  options.tracker.require_motion = false;
  TrackerStage stage(options, buffer_, monitor_);
  poseAt(99.9);
  poseAt(102.0);
  ObjectList list;
  list.objects = {Object()};
  list.objects[0].box = {Pose2(10.0, 0.0, 0.0), 1.0, 1.0};
  list.objects[0].position_covariance *= 0.01;
  TrackArrayPtr tracks;
  for (double seconds = 100.0; seconds < 101.0; seconds += 0.1) {
    list.stamp = Stamp::fromSeconds(seconds);
    list.objects[0].class_probabilities = {};
    stage.handleObjects(boost::make_shared<ObjectArray>(toMessage(list, "base_link")), list.stamp);
    tracks = stage.next(list.stamp);
    list.objects[0].class_probabilities = reportedClass(ObjectClass::kPedestrian, 0.9);
    stage.handleClasses(toMessage(list, "base_link"));
  }
  ASSERT_TRUE(tracks);
  ASSERT_EQ(tracks->tracks.size(), 1U);
  EXPECT_EQ(tracks->tracks[0].classification, ObjectMessage::CLASS_PEDESTRIAN);
  EXPECT_GT(tracks->tracks[0].class_probability, 0.95);
}

TEST_F(TrackerStageTest, ClassesInAnotherFrameAreDropped) {
  ObjectArray classes = *emptyList(100.0);
  classes.header.frame_id = "camera";
  stage_.handleClasses(classes);
  EXPECT_EQ(monitor_.drops().at("wrong_frame"), 1U);
}

TEST_F(TrackerStageTest, AJumpBackForgetsWhichTracksArePublished) {
  poseAt(109.9);
  poseAt(110.1);
  earlyObjectsAt(110.0);
  ASSERT_TRUE(nextAt(110.0));
  earlyObjectsAt(100.0);
  scanPoseAt(100.0);
  EXPECT_TRUE(nextAt(100.0));
}

}  // namespace
}  // namespace datmo::tracker_stage_test
