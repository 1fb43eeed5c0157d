#include "datmo_fusion/ros/object_fusion_stage.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "monitor_counts.h"
#include <gtest/gtest.h>

#include "datmo_fusion/ros/message_conversion.h"

namespace datmo {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// A car that `sensor` saw well, ahead and to the side in the vehicle's frame (m).
Object car(const std::string& sensor, double ahead, double left) {
  Object object;
  object.box = {{ahead, left, 0.0}, 4.0, 1.8};
  object.position_covariance = 0.04 * Eigen::Matrix2d::Identity();
  object.heading_variance = 0.01;
  object.side_variance.fill(0.01);
  object.sensors = {sensor};
  return object;
}

nav_msgs::Odometry odometry(double seconds) {
  nav_msgs::Odometry message;
  message.header.stamp = ros::Time(seconds);
  message.header.frame_id = "odom";
  message.child_frame_id = "base_link";
  message.twist.twist.linear.x = 20.0;
  return message;
}

class ObjectFusionStageTest : public testing::Test {
 protected:
  static ObjectArray list(double seconds, const std::vector<Object>& objects) {
    return toMessage(ObjectList{Stamp::fromSeconds(seconds), objects, {}}, "base_link");
  }

  /// A list of one car, which this source sees.
  void take(const std::string& source, double seconds, double ahead = 20.0, double left = 0.0) {
    take(source, list(seconds, {car(source, ahead, left)}));
  }

  void take(const std::string& source, const ObjectArray& objects) {
    stage_.takeObjects(source, objects, toStamp(objects.header.stamp));
  }

  ObjectArrayPtr nextAt(double seconds) { return stage_.next(Stamp::fromSeconds(seconds)); }

  /// Both sources see the same car at this time.
  ObjectArrayPtr bothAt(double seconds) {
    take("lidar", seconds);
    take("stereo", seconds);
    return nextAt(seconds);
  }

  std::uint64_t drops(const std::string& reason) const { return samples::drops(monitor_, reason); }
  std::uint64_t warnings(const std::string& reason) const {
    return samples::warnings(monitor_, reason);
  }
  double figure(const std::string& name) const { return monitor_.figures().at(name); }

  StageMonitor monitor_{"object_fusion"};
  ObjectFusionStageOptions options_;
  ObjectFusionStage stage_{options_, monitor_};
};

using Sensors = std::vector<std::string>;

/// The sensors of all objects of a list, in no order.
std::vector<Sensors> sensorsOf(const ObjectArray& list) {
  std::vector<Sensors> result;
  for (const ObjectMessage& object : list.objects) {
    result.push_back(object.sensors);
  }
  std::sort(result.begin(), result.end());
  return result;
}

TEST_F(ObjectFusionStageTest, ListsOfTheSameStampAreFusedAtOnce) {
  take("lidar", 100.0, 20.0);
  EXPECT_FALSE(nextAt(100.0)) << "the other one may still come";
  take("stereo", 100.0, 20.2);
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

TEST_F(ObjectFusionStageTest, WhatOneSourceSeesIsKept) {
  take("lidar", 100.0, 20.0, 0.0);
  take("stereo", 100.0, 20.0, 15.0);
  const auto fused = nextAt(100.0);
  ASSERT_TRUE(fused);
  EXPECT_EQ(sensorsOf(*fused), (std::vector<Sensors>{{"lidar"}, {"stereo"}}));
  EXPECT_EQ(figure("objects of two or more sources"), 0.0);
}

TEST_F(ObjectFusionStageTest, AnEmptyListIsOneToo) {
  take("lidar", list(100.0, {}));
  take("stereo", list(100.0, {}));
  const auto fused = nextAt(100.0);
  ASSERT_TRUE(fused) << "the tracker is to hear that nothing was seen";
  EXPECT_TRUE(fused->objects.empty());
}

TEST_F(ObjectFusionStageTest, AListIsFusedOnce) {
  stage_.takeOdometry(odometry(100.0));
  take("lidar", 100.0);
  take("stereo", 100.02);
  ASSERT_EQ(nextAt(100.02)->objects.size(), 1U);
  take("lidar", 100.06);
  const auto fused = nextAt(100.2);
  ASSERT_TRUE(fused);
  EXPECT_EQ(sensorsOf(*fused), std::vector<Sensors>{{"lidar"}});
  EXPECT_EQ(figure("fused without stereo"), 1.0);
  EXPECT_EQ(monitor_.warningCount(), 0U) << "it is slower, that is all";
}

TEST_F(ObjectFusionStageTest, ListsThatAreNotFusedAreCounted) {
  for (const double seconds : {100.0, 100.02, 100.04, 100.06, 100.08, 100.1}) {
    take("stereo", seconds);
  }
  take("lidar", 100.1);
  ASSERT_TRUE(nextAt(100.1));
  EXPECT_EQ(figure("lists of stereo not fused"), 5.0);
  EXPECT_EQ(figure("lists of lidar not fused"), 0.0);
}

TEST_F(ObjectFusionStageTest, ObjectsAreMovedByTheOdometryBetweenTheirStamps) {
  stage_.takeOdometry(odometry(99.9));
  stage_.takeOdometry(odometry(100.0));
  take("stereo", 99.95, 20.0, 15.0);
  take("lidar", list(100.0, {}));
  const auto fused = nextAt(100.2);
  ASSERT_TRUE(fused);
  ASSERT_EQ(fused->objects.size(), 1U);
  EXPECT_NEAR(fused->objects[0].pose.position.x, 19.0, 0.01) << "after 0.05 s at 20 m/s";
  EXPECT_NEAR(fused->objects[0].delay, -0.05, 1e-6);
}

TEST_F(ObjectFusionStageTest, WithoutOdometryTheyAreMovedByThePosesOfTheSlam) {
  options_.motion.odometry = false;
  ObjectFusionStage stage(options_, monitor_);
  stage.takeOdometry(odometry(0.0));
  for (const double t : {99.7, 99.8, 99.9}) {
    geometry_msgs::PoseWithCovarianceStamped pose;
    pose.header.stamp = ros::Time(t);
    pose.pose.pose = toMessage(Pose2(20.0 * t, 5.0, 0.0));
    stage.takePose(pose);
  }
  const Stamp now = Stamp::fromSeconds(100.0);
  stage.takeObjects("stereo", list(99.95, {car("stereo", 20.0, 15.0)}), now);
  stage.takeObjects("lidar", list(100.0, {}), now);
  const auto fused = stage.next(Stamp::fromSeconds(100.2));
  ASSERT_TRUE(fused);
  ASSERT_EQ(fused->objects.size(), 1U);
  EXPECT_NEAR(fused->objects[0].pose.position.x, 19.0, 0.01);
  EXPECT_EQ(monitor_.droppedCount(), 0U) << "odometry is not read";
}

TEST_F(ObjectFusionStageTest, AListWhoseMotionIsNotKnownIsLeftOut) {
  for (int i = 0; i <= 10; ++i) {
    const double t = 100.0 + 0.1 * i;
    take("stereo", t - 0.05);
    take("lidar", t);
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

TEST_F(ObjectFusionStageTest, ASilentSourceIsSaidOnceAndTheOthersGoOn) {
  for (const std::string source : {"lidar", "stereo"}) {
    const double start = source == "lidar" ? 100.0 : 200.0;
    EXPECT_TRUE(bothAt(start));
    const std::uint64_t before = warnings("silent_source");
    int fused = 0;
    for (int i = 1; i < 20; ++i) {
      const double t = start + 0.1 * i;
      take(source, t);
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

TEST_F(ObjectFusionStageTest, ASourceThatIsAlwaysTooLateIsSaidOnce) {
  for (int i = 0; i < 10; ++i) {
    const double t = 100.0 + 0.1 * i;
    take("lidar", t);
    EXPECT_TRUE(nextAt(t + 0.11));
    take("stereo", t - 0.15);
  }
  EXPECT_EQ(warnings("late_source"), 1U);
  EXPECT_EQ(monitor_.warningCount(), 1U);
  EXPECT_GT(figure("lists of stereo not fused"), 5.0);
}

TEST_F(ObjectFusionStageTest, AStampFarAheadOfTheReferenceIsDropped) {
  take("lidar", 100.0);
  stage_.takeObjects("stereo", list(100.7, {}), Stamp::fromSeconds(100.0));
  EXPECT_EQ(drops("stamp_ahead"), 1U);
  const auto fused = nextAt(100.11);
  ASSERT_TRUE(fused);
  EXPECT_EQ(fused->header.stamp, ros::Time(100.0));
}

TEST_F(ObjectFusionStageTest, BadListsAreDroppedAndCounted) {
  ObjectArray objects = list(100.0, {});
  objects.header.frame_id = "map";
  take("lidar", objects);
  EXPECT_EQ(drops("wrong_frame"), 1U);
  EXPECT_NE(monitor_.lastError().find("object list of lidar in 'map'"), std::string::npos);
  take("radar", 100.0);
  EXPECT_EQ(drops("unknown_source"), 1U);
  take("lidar", 0.0);
  EXPECT_EQ(drops("zero_stamp"), 1U);
  take("lidar", 100.0);
  take("lidar", 100.0);
  EXPECT_EQ(drops("repeated_stamp"), 1U);
  take("lidar", 99.9);
  EXPECT_EQ(drops("old_stamp"), 1U);
  take("stereo", 100.0);
  EXPECT_EQ(sensorsOf(*nextAt(100.0)), (std::vector<Sensors>{{"lidar", "stereo"}}));
}

TEST_F(ObjectFusionStageTest, BadObjectsAreLeftOutAndTheirSourceIsNamed) {
  std::vector<Object> bad(5, car("stereo", 20.0, 0.0));
  bad[0].position_covariance.setZero();
  bad[1].position_covariance << 1.0, 2.0, 2.0, 1.0;
  bad[2].position_covariance(0, 1) = kNan;
  bad[3].box.centre = {kNan, 0.0, 0.0};
  bad[4].side_variance[0] = -1.0;
  for (std::size_t i = 0; i < bad.size(); ++i) {
    const double t = 100.0 + 0.1 * static_cast<double>(i);
    take("lidar", t);
    take("stereo", list(t, {bad[i], car("stereo", 20.0, 0.0)}));
    const auto fused = nextAt(t);
    ASSERT_TRUE(fused);
    EXPECT_EQ(sensorsOf(*fused), (std::vector<Sensors>{{"lidar", "stereo"}})) << i;
    EXPECT_EQ(warnings("bad_object"), i + 1U);
    EXPECT_NE(monitor_.lastError().find("1 objects of stereo"), std::string::npos);
  }
  EXPECT_EQ(figure("bad objects"), 5.0);
}

TEST_F(ObjectFusionStageTest, BadViewsAreLeftOutAndSaid) {
  ObjectArray objects = list(100.0, {car("stereo", 20.0, 0.0)});
  objects.views.resize(2);
  objects.views[0].least_bearing = -30.0F;  // degrees
  objects.views[0].most_bearing = 30.0F;
  objects.views[1].least_bearing = -0.5F;
  objects.views[1].most_bearing = 0.5F;
  take("lidar", 100.0);
  take("stereo", objects);
  const auto fused = nextAt(100.0);
  ASSERT_TRUE(fused);
  EXPECT_EQ(warnings("bad_view"), 1U);
  EXPECT_NE(monitor_.lastError().find("1 views of stereo"), std::string::npos);
  ASSERT_EQ(fused->views.size(), 1U);
  EXPECT_EQ(fused->views[0].sensor, "stereo") << "as of objects that do not tell it";
}

TEST_F(ObjectFusionStageTest, OfAThousandObjectsTheFarthestAreLeftOut) {
  std::vector<Object> many;
  for (int i = 0; i < 1000; ++i) {
    many.push_back(car("stereo", 20.0 + 5.0 * (i % 100), 15.0 + 5.0 * (i / 100)));
  }
  take("lidar", 100.0);
  take("stereo", list(100.0, many));
  const auto fused = nextAt(100.0);
  ASSERT_TRUE(fused);
  const auto most = static_cast<std::size_t>(options_.fuser.most_objects);
  EXPECT_EQ(fused->objects.size(), most + 1);
  EXPECT_EQ(warnings("many_objects"), 1U);
  EXPECT_NE(monitor_.lastError().find("stereo"), std::string::npos);
  EXPECT_TRUE(bothAt(100.1));
  EXPECT_EQ(warnings("many_objects"), 1U);
}

TEST_F(ObjectFusionStageTest, ObjectsThatDoNotTellTheirSensorAreTheSources) {
  Object object = car("stereo", 20.0, 0.0);
  object.sensors.clear();
  take("stereo", list(100.0, {object}));
  take("lidar", 100.0);
  EXPECT_EQ(sensorsOf(*nextAt(100.0)), (std::vector<Sensors>{{"lidar", "stereo"}}));
}

TEST_F(ObjectFusionStageTest, AJumpBackStartsAnew) {
  EXPECT_TRUE(bothAt(200.0));
  EXPECT_TRUE(bothAt(100.0));
  EXPECT_EQ(warnings("clock_restart"), 1U) << "the other source is part of the same restart";
  stage_.takeOdometry(odometry(200.0));
  stage_.takeOdometry(odometry(100.1));
  EXPECT_EQ(warnings("clock_restart"), 2U);
  EXPECT_TRUE(bothAt(99.9));
  EXPECT_EQ(monitor_.droppedCount(), 0U);
}

/// Beams one degree apart, straight ahead in the middle; all that look at the car's place end there
/// on what the map knows.
SplitScanMessage wallAt(double ahead, double seconds) {
  SplitScan scan;
  scan.stamp = Stamp::fromSeconds(seconds);
  scan.field.beams = 181;
  scan.field.first_bearing = -kPi / 2.0;
  scan.field.beam_spacing = kPi / 180.0;
  scan.field.free_range = 80.0;
  scan.field.range = 80.0;
  for (std::uint32_t beam = 80; beam <= 100; ++beam) {
    const double bearing = scan.field.first_bearing + beam * scan.field.beam_spacing;
    const double range = ahead / std::cos(bearing);
    scan.points.push_back(
        {{ahead, range * std::sin(bearing)}, range, bearing, beam, PointState::kStatic});
  }
  return toMessage(scan, "base_link", "map");
}

class ObjectFusionWitnessTest : public ObjectFusionStageTest {
 protected:
  /// State of the one object that stereo sees and the scanner does not list.
  std::uint8_t stateAt(double seconds) {
    take("lidar", list(seconds, {}));
    take("stereo", seconds, 20.0);
    const auto fused = nextAt(seconds);
    return fused && fused->objects.size() == 1 ? fused->objects[0].dynamic_state : 255;
  }
};

TEST_F(ObjectFusionWitnessTest, TheScanOfTheSameStampTellsWhatStandsStill) {
  EXPECT_EQ(stateAt(100.0), ObjectMessage::STATE_UNKNOWN) << "no scan";
  stage_.takeSplitScan(wallAt(18.0, 100.1));
  EXPECT_EQ(stateAt(100.1), ObjectMessage::STATE_STATIC);
  EXPECT_EQ(stateAt(100.2), ObjectMessage::STATE_UNKNOWN) << "the scan is of another time";
  EXPECT_EQ(figure("fused without a split scan"), 2.0);
}

TEST_F(ObjectFusionWitnessTest, AScanMayComeBeforeOthers) {
  for (int i = 0; i < 40; ++i) {
    stage_.takeSplitScan(wallAt(18.0, 100.0 + 0.02 * i));
  }
  EXPECT_EQ(stateAt(100.0), ObjectMessage::STATE_STATIC);
}

TEST_F(ObjectFusionWitnessTest, BadScansAreDroppedAndCounted) {
  SplitScanMessage scan = wallAt(18.0, 100.0);
  scan.points[0].x = std::numeric_limits<float>::infinity();
  stage_.takeSplitScan(scan);
  EXPECT_EQ(drops("bad_point"), 1U);
  scan = wallAt(18.0, 100.0);
  scan.header.frame_id = "scanner";
  stage_.takeSplitScan(scan);
  EXPECT_EQ(drops("wrong_frame"), 1U);
  EXPECT_EQ(stateAt(100.0), ObjectMessage::STATE_UNKNOWN);
}

TEST_F(ObjectFusionWitnessTest, AJumpBackForgetsTheScans) {
  EXPECT_TRUE(bothAt(199.0));
  stage_.takeSplitScan(wallAt(18.0, 200.0));
  EXPECT_TRUE(bothAt(100.0));
  EXPECT_EQ(warnings("clock_restart"), 1U);
  EXPECT_EQ(stateAt(200.0), ObjectMessage::STATE_UNKNOWN);
}

TEST_F(ObjectFusionWitnessTest, AScanOfANewRunIsNotLostBehindThoseOfTheOldOne) {
  stage_.takeSplitScan(wallAt(18.0, 200.0));
  stage_.takeSplitScan(wallAt(18.0, 100.0));
  EXPECT_EQ(stateAt(100.0), ObjectMessage::STATE_STATIC);
}

TEST(ObjectFusionStageOptionsTest, BadOptionsAreRefused) {
  StageMonitor monitor("object_fusion");
  const auto refused = [&monitor](const std::function<void(ObjectFusionStageOptions&)>& spoil) {
    ObjectFusionStageOptions options;
    spoil(options);
    EXPECT_THROW(ObjectFusionStage(options, monitor), OptionError);
  };
  refused([](auto& options) { options.matcher.reference = "radar"; });
  refused([](auto& options) { options.fuser.sources["lidar"].use = false; });
  refused([](auto& options) { options.matcher.longest_wait = kNan; });
  for (const char* const name : {"fused", "", "2nd", "rear-lidar", "a b"}) {
    refused([&](auto& options) { options.fuser.sources[name].use = true; });
  }
}

}  // namespace
}  // namespace datmo
