// SPDX-License-Identifier: BSD-3-Clause
// Classes that a slow detector reports only after the tracks of their scan were published: no scan
// waits for them, and object_fusion gives each to the right one of two road users that pass each
// other closely, in the first scan after it has arrived.
#include <cstddef>
#include <optional>
#include <vector>

#include "fusion/fusion_objects.h"
#include "object_fusion_sample.h"
#include <gtest/gtest.h>

#include "datmo_fusion/common/class_belief.h"
#include "datmo_fusion/tracking/tracker.h"

namespace datmo::late_class_fusion_test {
namespace {

constexpr double kStart = 100.0;  // s
constexpr double kPeriod = 0.1;   // s
constexpr std::size_t kSteps = 30;
constexpr double kLateBy = 0.4;         // s, as with mono:=true
constexpr double kVehicleSpeed = 20.0;  // m/s, of ObjectFusionStageTest::odometry
constexpr double kPassingAt = 90.0;     // m ahead of the vehicle's start
constexpr double kPassingTime = 1.5;    // s after the start
constexpr double kSpeed = 4.0;          // m/s; a class of 0.3 s ago is 1.2 m behind its object
constexpr double kDistance = 1.5;       // m, between their lines
constexpr double kProbability = 0.8;    // of the reported class
constexpr std::size_t kConfirmed = 6;   // classes until tracks have theirs, at the latest

double timeOf(std::size_t step) { return kStart + kPeriod * static_cast<double>(step); }
Pose2 vehicleAt(double seconds) { return {kVehicleSpeed * (seconds - kStart), 0.0, 0.0}; }

/// m, in the map.
Point2 cyclistAt(double seconds) {
  return {kPassingAt + kSpeed * (seconds - kStart - kPassingTime), 0.0};
}
Point2 carAt(double seconds) {
  return {kPassingAt - kSpeed * (seconds - kStart - kPassingTime), kDistance};
}

/// As the scanner sees it: both are of a cyclist's size, so that only reports make one a vehicle.
Object seenAt(const Point2& position, double seconds) {
  const Point2 in_base = vehicleAt(seconds).inverse() * position;
  return boxObject(in_base.x(), in_base.y(), 1.7, 0.6, 0.01);
}

struct Classified {
  Point2 position;
  ObjectClass object_class;
};

/// Returns the class of what is there; none if nothing is.
std::optional<ObjectClass> classAt(const std::vector<Classified>& all, const Point2& position) {
  constexpr double kNear = 0.5;  // m
  for (const Classified& one : all) {
    if ((one.position - position).norm() < kNear) {
      return one.object_class;
    }
  }
  return {};
}

std::vector<Classified> classesOf(const ObjectList& list, const Pose2& base) {
  std::vector<Classified> result;
  for (const Object& object : list.objects) {
    result.push_back({base * object.box.center.position(), object.objectClass()});
  }
  return result;
}

std::vector<Classified> classesOf(const TrackList& list) {
  std::vector<Classified> result;
  for (const Track& track : list.tracks) {
    result.push_back({track.box.center.position(), track.objectClass()});
  }
  return result;
}

class LateClassFusionTest : public ObjectFusionStageTest {
 protected:
  LateClassFusionTest() : ObjectFusionStageTest(withMono()) {}

  static std::vector<Object> objectsAt(double seconds) {
    return {seenAt(cyclistAt(seconds), seconds), seenAt(carAt(seconds), seconds)};
  }

  /// The detector reports the classes of this time now.
  void report(double seconds, double now) {
    const std::vector<Object> objects = objectsAt(seconds);
    handle("mono",
           list(seconds, {classOnly(objects[0], ObjectClass::kCyclist, kProbability),
                          classOnly(objects[1], ObjectClass::kVehicle, kProbability)}),
           Stamp::fromSeconds(now));
  }

  static void expectClasses(const std::vector<Classified>& all, double seconds) {
    EXPECT_EQ(classAt(all, cyclistAt(seconds)), ObjectClass::kCyclist) << seconds;
    EXPECT_EQ(classAt(all, carAt(seconds)), ObjectClass::kVehicle) << seconds;
  }

 private:
  static ObjectFusionStageOptions withMono() {
    ObjectFusionStageOptions options;
    options.fuser.sources["stereo"].use = false;
    options.fuser.sources["mono"].late_by = kLateBy;
    return options;
  }
};

/// By the number of scans whose tracks are published before the classes of the first one arrive.
class LateClassDelayTest : public LateClassFusionTest,
                           public testing::WithParamInterface<std::size_t> {};

TEST_P(LateClassDelayTest, EachReachesTheRightOneOfTwoThatPassEachOther) {
  TrackerOptions tracker_options;
  tracker_options.require_motion = false;
  Tracker tracker(tracker_options);
  for (std::size_t step = 0; step < kSteps; ++step) {
    const double now = timeOf(step);
    stage_.handleOdometry(odometry(now));
    handle("lidar", list(now, objectsAt(now)));
    const ObjectArrayPtr fused = nextAt(now);
    ASSERT_TRUE(fused) << "no scan waits for classes";
    ASSERT_EQ(fused->header.stamp, ros::Time(now));
    const ObjectList objects = fromMessage(*fused);
    const TrackList tracks = tracker.process(objects, vehicleAt(now));
    EXPECT_EQ(objects.objects.size(), 2U);
    if (step >= GetParam()) {
      expectClasses(classesOf(objects, vehicleAt(now)), now);
    }
    if (step >= GetParam() + kConfirmed) {
      expectClasses(classesOf(tracks), now);
    }
    if (step + 1 >= GetParam()) {
      report(timeOf(step + 1 - GetParam()), now);
    }
  }
  EXPECT_EQ(figure("lists of mono not fused"), 0.0);
  EXPECT_EQ(figure("classes for missing objects"), 0.0);
  EXPECT_EQ(monitor_.droppedCount() + monitor_.warningCount(), 0U);
}

INSTANTIATE_TEST_SUITE_P(Scans, LateClassDelayTest, testing::Values(1U, 2U, 3U));

TEST_F(LateClassFusionTest, ThoseThatAreTooLateAreInNoScanAndCounted) {
  handle("lidar", list(kStart, objectsAt(kStart)));
  ASSERT_TRUE(nextAt(kStart));
  const double later = kStart + kLateBy + kPeriod;
  stage_.handleOdometry(odometry(kStart));
  stage_.handleOdometry(odometry(later));
  report(kStart, later);
  handle("lidar", list(later, objectsAt(later)));
  const ObjectArrayPtr fused = nextAt(later);
  ASSERT_TRUE(fused);
  for (const Object& object : fromMessage(*fused).objects) {
    EXPECT_EQ(object.objectClass(), ObjectClass::kUnknown);
  }
  EXPECT_EQ(figure("lists of mono not fused"), 1.0);
}

}  // namespace
}  // namespace datmo::late_class_fusion_test
