// SPDX-License-Identifier: BSD-3-Clause
// The running object_fusion nodelet, fed by the lists of a scripted scanner and stereo camera: the
// output, and what happens if one of them is silent or sends invalid messages. The tests run
// through one drive, in this order.
#include <algorithm>
#include <limits>
#include <string>
#include <vector>

#include "ros/seen_object.h"
#include "source_lists.h"
#include <gtest/gtest.h>

#include <nav_msgs/Odometry.h>

#include "datmo_fusion/ros/convert/message_conversion.h"

namespace datmo::object_fusion_test {
namespace {

constexpr double kSpeed = 10.0;       // m/s, of the vehicle
constexpr double kCarAhead = 20.0;    // m, of a car that is as fast as the vehicle
constexpr double kPoleAhead = 200.0;  // m, of a pole when the drive starts, which stereo alone sees
constexpr double kPoleLeft = 15.0;    // m

/// The sensors' lists and the odometry for the nodelet, and its output.
class Lists : public SourceLists<ObjectArray> {
 public:
  Lists() : SourceLists("objects", "object_fusion") {}

  static ObjectArray listOf(const std::string& sensor, double seconds) {
    ObjectList list{Stamp::fromSeconds(kStart + seconds), {}, {}};
    list.objects.push_back(samples::seenObject(sensor, {{kCarAhead, 0.0, 0.0}, 4.0, 1.8}));
    if (sensor == "stereo") {
      const double ahead = kPoleAhead - kSpeed * seconds;
      list.objects.push_back(samples::seenObject(sensor, {{ahead, kPoleLeft, 0.0}, 0.2, 0.2}));
    }
    return toMessage(list, "base_link");
  }

  bool waitForNodelet() {
    if (!SourceLists::waitForNodelet() ||
        !waitFor([this] { return odometry_.getNumSubscribers() >= 1; })) {
      return false;
    }
    startStep(-kStep);
    return waitFor([this] { return diagnostic("odometry received") >= 1.0; });
  }

  /// Sends clock and odometry.
  void startStep(double seconds) {
    setClock(seconds);
    nav_msgs::Odometry odometry;
    odometry.header.stamp = ros::Time(kStart + seconds);
    odometry.header.frame_id = "odom";
    odometry.child_frame_id = "base_link";
    odometry.pose.pose.orientation.w = 1.0;
    odometry.twist.twist.linear.x = kSpeed;
    odometry_.publish(odometry);
  }

 private:
  ros::NodeHandle node_;
  ros::Publisher odometry_ = node_.advertise<nav_msgs::Odometry>("odometry", 1, true);
};

class ObjectFusionTest : public SourceListsTest<Lists> {
 protected:
  /// Returns the sensors that saw the object nearest to a point (m) in the last list; none if there
  /// is no object within a meter.
  static Sensors sensorsAt(double ahead, double left) {
    for (const ObjectMessage& object : last().objects) {
      const Point2 position(object.pose.position.x, object.pose.position.y);
      if ((position - Point2(ahead, left)).norm() < 1.0) {
        return object.sensors;
      }
    }
    return {};
  }

  static double diagnostic(const std::string& key) { return lists_->diagnostic(key); }
  static bool waitForCount(const std::string& key, double count) {
    return lists_->waitForCount(key, count);
  }
};

TEST_F(ObjectFusionTest, AnObjectSeenByBothIsOneObject) {
  ASSERT_NO_FATAL_FAILURE(driveOn(16));
  EXPECT_EQ(lists_->fused.size(), 16U);
  EXPECT_EQ(last().header.frame_id, "base_link");
  EXPECT_EQ(last().objects.size(), 2U);
  EXPECT_EQ(sensorsAt(kCarAhead, 0.0), (Sensors{"lidar", "stereo"}));
}

TEST_F(ObjectFusionTest, ObjectsOfStereoAloneAreMovedToTheScannersTime) {
  ASSERT_NO_FATAL_FAILURE(step());
  const double then = toStamp(last().header.stamp).seconds() - kStart;
  const auto pole =
      std::find_if(last().objects.begin(), last().objects.end(),
                   [](const ObjectMessage& object) { return object.sensors == Sensors{"stereo"}; });
  ASSERT_NE(pole, last().objects.end());
  EXPECT_NEAR(pole->pose.position.x, kPoleAhead - kSpeed * then, 0.01);
  EXPECT_NEAR(pole->pose.position.y, kPoleLeft, 0.01);
  EXPECT_NEAR(pole->delay, kStereoLater, 1e-6);
  EXPECT_TRUE(waitForCount("objects of two or more sources", 1.0));
  EXPECT_EQ(diagnostic("dropped"), 0.0);
}

TEST_F(ObjectFusionTest, WithoutStereoTheScannersObjectsContinue) {
  const std::size_t before = lists_->fused.size();
  for (int i = 0; i < 20; ++i) {
    sendLidarStep();
    now_ += kStep;
  }
  EXPECT_TRUE(lists_->waitFor([] { return lists_->isAt(now_ - kStep); }))
      << "at once, since stereo is silent";
  EXPECT_EQ(lists_->fused.size(), before + 20U) << "none is left out";
  EXPECT_EQ(sensorsAt(kCarAhead, 0.0), Sensors{"lidar"});
  // One more if the first list of the scanner was fused before stereo was known.
  EXPECT_TRUE(lists_->waitFor([] { return diagnostic("fused without stereo") >= 20.0; }));
  EXPECT_TRUE(waitForCount("warned: silent_source", 1.0));
  EXPECT_TRUE(lists_->waitFor([] {
    return lists_->diagnosticMessage().find("no objects/stereo") != std::string::npos;
  })) << lists_->diagnosticMessage();
}

TEST_F(ObjectFusionTest, WhenStereoIsBackItIsFusedAgain) {
  ASSERT_NO_FATAL_FAILURE(driveOn(4));
  EXPECT_EQ(sensorsAt(kCarAhead, 0.0), (Sensors{"lidar", "stereo"}));
}

TEST_F(ObjectFusionTest, AListInAnotherFrameIsRefused) {
  ObjectArray bad = Lists::listOf("stereo", now_);
  bad.header.frame_id = "camera";
  lists_->sendStereo(bad);
  EXPECT_TRUE(waitForCount("dropped: wrong_frame", 1.0));
  ASSERT_NO_FATAL_FAILURE(driveOn(4));
  EXPECT_EQ(sensorsAt(kCarAhead, 0.0), (Sensors{"lidar", "stereo"}));
}

TEST_F(ObjectFusionTest, BadObjectsAreLeftOutAndCounted) {
  ObjectArray bad = Lists::listOf("stereo", now_ + kStereoLater);
  bad.objects[0].position_covariance.fill(0.0);
  bad.objects[1].pose.position.x = std::numeric_limits<double>::quiet_NaN();
  ASSERT_NO_FATAL_FAILURE(step(bad));
  EXPECT_EQ(last().objects.size(), 1U);
  EXPECT_EQ(sensorsAt(kCarAhead, 0.0), Sensors{"lidar"});
  EXPECT_TRUE(waitForCount("bad objects", 2.0));
  EXPECT_EQ(diagnostic("warned: bad_object"), 1.0);
  ASSERT_NO_FATAL_FAILURE(driveOn(4));
  EXPECT_EQ(sensorsAt(kCarAhead, 0.0), (Sensors{"lidar", "stereo"}));
}

TEST_F(ObjectFusionTest, ALoopedBag) {
  now_ = 0.0;
  lists_->startStep(now_);
  ASSERT_TRUE(waitForCount("warned: clock_restart", 1.0));
  ASSERT_NO_FATAL_FAILURE(driveOn(8));
  EXPECT_EQ(sensorsAt(kCarAhead, 0.0), (Sensors{"lidar", "stereo"}));
  EXPECT_TRUE(waitForCount("warned: clock_restart", 1.0));
}

}  // namespace
}  // namespace datmo::object_fusion_test
