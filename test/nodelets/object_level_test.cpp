// SPDX-License-Identifier: BSD-3-Clause
// Scanner and stereo camera, fused at the object level, on a simulated drive: the output, and what
// happens if one of them is silent or sends invalid messages. The tests run through one drive, in
// this order, without low-level fusion and with it.
#include <algorithm>
#include <limits>

#include "ros/pedestrian_sample.h"
#include "stereo_drive.h"
#include <gtest/gtest.h>

#include "datmo_fusion/ros/convert/message_conversion.h"

namespace datmo::object_level_test {
namespace {

constexpr std::uint32_t kQueue = 1000;

const std::vector<std::string> kBothSensors = {"lidar", "stereo"};

/// The object level's output from both sensors.
class ObjectLevel : public StereoChain {
 public:
  static constexpr char kFusion[] = "object_fusion";

  /// Waits until all nodelets are subscribed and report.
  bool waitForNodelets() {
    return StereoChain::waitForNodelets({"stereo_objects", "object_fusion", "tracker"}) &&
           waitFor([this] {
             return stereo_.getNumPublishers() >= 1 && fused_.getNumPublishers() >= 1 &&
                    external_.getNumSubscribers() >= 2;
           });
  }

  /// Publishes in place of stereo_objects.
  void sendStereoObjects(const ObjectArray& list) { external_.publish(list); }

  /// Returns whether there are as many fused lists as lists of the scanner: either may arrive
  /// first.
  bool waitForAllFused() {
    return waitFor([this] { return fused.size() == objects.size(); });
  }

  bool isFusedAt(const ros::Time& stamp) const {
    return !fused.empty() && fused.back()->header.stamp == stamp;
  }

  std::vector<ObjectArrayConstPtr> stereo;
  std::vector<ObjectArrayConstPtr> fused;

 private:
  ros::NodeHandle node_;
  ros::Subscriber stereo_ = node_.subscribe<ObjectArray>(
      "objects/stereo", kQueue,
      [this](const ObjectArrayConstPtr& list) { stereo.push_back(list); });
  ros::Subscriber fused_ = node_.subscribe<ObjectArray>(
      "objects/fused", kQueue, [this](const ObjectArrayConstPtr& list) { fused.push_back(list); });
  ros::Publisher external_ = node_.advertise<ObjectArray>("objects/stereo", kQueue);
};

class ObjectLevelTest : public StereoDriveTest<ObjectLevel> {
 protected:
  /// Returns the other car in a list of objects; null if it is not there.
  const ObjectMessage* otherCarIn(const ObjectArray& list) const {
    const double then = list.header.stamp.toSec() - World::kStart;
    Box2 car = world_.otherCar(then);
    car.center = world_.baseInMap(then).inverse() * car.center;
    const auto found =
        std::find_if(list.objects.begin(), list.objects.end(), [&](const ObjectMessage& object) {
          return car.distanceTo({object.pose.position.x, object.pose.position.y}) < 1.0;
        });
    return found == list.objects.end() ? nullptr : &*found;
  }
};

TEST_F(ObjectLevelTest, BothSensorsLeadToFusedObjectsForEachScan) {
  chain_->sendCameraInfo();
  chain_->mountSensors();
  ASSERT_NO_FATAL_FAILURE(start());
  ASSERT_NO_FATAL_FAILURE(driveOn(2.0));
  EXPECT_TRUE(chain_->waitForAllFused());
  EXPECT_EQ(chain_->fused.back()->header.frame_id, "base_link");
  ASSERT_EQ(chain_->fused.back()->views.size(), 1U);
  EXPECT_EQ(chain_->fused.back()->views.front().sensor, "stereo");
  EXPECT_EQ(chain_->diagnostic("object_fusion", "dropped"), 0.0);
  EXPECT_EQ(chain_->diagnostic("stereo_objects", "dropped"), 0.0);
}

TEST_F(ObjectLevelTest, AnObjectSeenByBothIsOneObject) {
  ASSERT_NO_FATAL_FAILURE(driveOn(0.5));
  ASSERT_TRUE(otherCarIn(*chain_->stereo.back()));
  const ObjectMessage* car = otherCarIn(*chain_->fused.back());
  ASSERT_TRUE(car);
  EXPECT_EQ(car->sensors, kBothSensors);
  EXPECT_EQ(car->dynamic_state, ObjectMessage::STATE_MOVING);
}

TEST_F(ObjectLevelTest, FusedObjectsLeadToTracks) {
  const ros::Time last = chain_->fused.back()->header.stamp;
  ASSERT_TRUE(chain_->waitFor([&] {
    return !chain_->tracks.empty() && chain_->tracks.back()->header.stamp == last;
  })) << chain_->diagnosticMessage("tracker");
  const TrackMessage* car = chain_->otherCarIn(*chain_->tracks.back());
  ASSERT_TRUE(car) << chain_->tracks.back()->tracks.size() << " tracks, none there";
  EXPECT_TRUE(car->moving);
  EXPECT_EQ(car->sensors, kBothSensors);
}

TEST_F(ObjectLevelTest, WithoutStereoTheFusedObjectsContinueWithTheScanner) {
  for (int i = 0; i < 20; ++i) {
    ASSERT_NO_FATAL_FAILURE(stepWithoutStereo());
  }
  const ros::Time last(World::kStart + now_ - kStep);
  EXPECT_TRUE(chain_->waitFor([&] { return chain_->isFusedAt(last); }))
      << "at once, since stereo is silent";
  EXPECT_TRUE(chain_->waitForAllFused()) << "none is left out";
  EXPECT_TRUE(chain_->fused.back()->views.empty());
  EXPECT_TRUE(chain_->waitFor(
      [] { return chain_->diagnostic("object_fusion", "warned: silent_source") == 1.0; }));
  ASSERT_NO_FATAL_FAILURE(driveOn(0.5));
}

TEST_F(ObjectLevelTest, BadCloudsAreCounted) {
  sensor_msgs::PointCloud2 cloud = world_.cloud(now_);
  std::fill(cloud.data.begin(), cloud.data.end(), 0xFF);
  chain_->sendCloud(cloud);
  EXPECT_TRUE(chain_->waitFor(
      [] { return chain_->diagnostic("stereo_objects", "dropped: no_valid_point") == 1.0; }));
  ASSERT_NO_FATAL_FAILURE(driveOn(0.5));
}

TEST_F(ObjectLevelTest, AnotherSystemMayPublishTheStereoObjects) {
  ObjectArray list = pedestrianAt(Stamp::fromSeconds(World::kStart + now_));
  ObjectMessage nowhere = list.objects[0];
  nowhere.pose.position.x = std::numeric_limits<double>::quiet_NaN();
  list.objects.push_back(nowhere);
  chain_->sendStereoObjects(list);
  ASSERT_NO_FATAL_FAILURE(stepWithoutStereo());
  ASSERT_NO_FATAL_FAILURE(driveOn(0.5));
  const auto of_that_time = std::find_if(
      chain_->fused.begin(), chain_->fused.end(),
      [&](const ObjectArrayConstPtr& one) { return one->header.stamp == list.header.stamp; });
  ASSERT_NE(of_that_time, chain_->fused.end());
  const auto& fused = (*of_that_time)->objects;
  EXPECT_TRUE(std::any_of(fused.begin(), fused.end(), [](const ObjectMessage& object) {
    return object.classification == ObjectMessage::CLASS_PEDESTRIAN &&
           object.sensors == std::vector<std::string>{"stereo"};
  }));
  EXPECT_TRUE(std::all_of(fused.begin(), fused.end(), [](const ObjectMessage& object) {
    return std::isfinite(object.pose.position.x);
  }));
}

TEST_F(ObjectLevelTest, ALoopedBag) {
  now_ = 0.0;
  ASSERT_NO_FATAL_FAILURE(start());
  ASSERT_NO_FATAL_FAILURE(driveOn(1.0));
  EXPECT_TRUE(chain_->waitFor(
      [] { return chain_->diagnostic("object_fusion", "warned: clock_restart") > 0.0; }));
}

}  // namespace
}  // namespace datmo::object_level_test
