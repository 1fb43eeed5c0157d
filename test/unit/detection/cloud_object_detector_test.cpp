// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/detection/cloud_object_detector.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lidar_samples.h"
#include <gtest/gtest.h>

namespace datmo::cloud_object_detector_test {
namespace {

using samples::LidarCloudMaker;

constexpr double kBodyFloor = 0.2;  // m above the ground, of the body of a vehicle

/// The sides of an upright box that face the lidar at (0.5, 0), with points 5 cm apart that are
/// exact to 1 mm.
void addBox(LidarCloudMaker& maker, const Box2& box, double height) {
  const Point2 lidar(0.5, 0.0);
  const Pose2& at = box.center;
  const Point2 seen = at.inverse() * lidar;
  const double end = 0.5 * box.length;
  const double side = 0.5 * box.width;
  for (double z = kBodyFloor; z <= height; z += 0.05) {
    if (std::abs(seen.x()) > end) {
      for (double y = -side; y <= side; y += 0.05) {
        const Point2 point = at * Point2(std::copysign(end, seen.x()), y);
        maker.add(point.x(), point.y(), z);
      }
    }
    if (std::abs(seen.y()) > side) {
      for (double x = -end; x <= end; x += 0.05) {
        const Point2 point = at * Point2(x, std::copysign(side, seen.y()));
        maker.add(point.x(), point.y(), z);
      }
    }
  }
}

const Box2 kCarAhead{Pose2(12.0, 3.0, 0.0), 4.2, 1.8};

CloudObjects detect(const LidarCloudMaker& maker, const std::optional<Twist2>& twist = {}) {
  return CloudObjectDetector(CloudObjectDetectorOptions())
      .detect(maker.cloud, Stamp::fromSeconds(100.0), twist);
}

TEST(CloudObjectDetectorTest, TwoCarsAndAPedestrianOnARoad) {
  LidarCloudMaker maker;
  maker.addGround();
  addBox(maker, kCarAhead, 1.5);
  addBox(maker, {Pose2(10.0, -4.0, 0.0), 4.4, 1.8}, 1.5);
  addBox(maker, {Pose2(6.0, 5.0, 0.0), 0.5, 0.5}, 1.75);
  CloudObjects found = detect(maker);
  EXPECT_TRUE(found.ground.seen);
  ASSERT_EQ(found.list.objects.size(), 3U);
  auto& objects = found.list.objects;
  std::sort(objects.begin(), objects.end(),
            [](const Object& a, const Object& b) { return a.box.center.x() < b.box.center.x(); });
  EXPECT_EQ(objects[0].objectClass(), ObjectClass::kPedestrian);
  EXPECT_EQ(objects[1].objectClass(), ObjectClass::kVehicle);
  EXPECT_EQ(objects[2].objectClass(), ObjectClass::kVehicle);
  EXPECT_EQ(objects[2].sensors, std::vector<std::string>{"cloud"});
  EXPECT_NEAR(objects[2].height, 1.5, 0.1);
}

TEST(CloudObjectDetectorTest, ACarsBoxFitsItsVisibleSides) {
  LidarCloudMaker maker;
  maker.addGround();
  addBox(maker, kCarAhead, 1.5);
  const CloudObjects found = detect(maker);
  ASSERT_EQ(found.list.objects.size(), 1U);
  const Object& car = found.list.objects.front();
  EXPECT_NEAR(std::remainder(car.box.center.heading(), kPi), 0.0, degrees(3.0));
  EXPECT_NEAR(car.box.center.x(), 12.0, 0.2);
  EXPECT_NEAR(car.box.center.y(), 3.0, 0.2);
  EXPECT_NEAR(car.box.length, 4.2, 0.25);
  EXPECT_NEAR(car.box.width, 1.8, 0.25);
  const auto unknown_sides =
      std::count(car.side_variance.begin(), car.side_variance.end(), kHiddenSide);
  EXPECT_EQ(unknown_sides, 0) << "both far sides are where the near ones end";
}

TEST(CloudObjectDetectorTest, AnOccludedObjectHasUnknownEnds) {
  LidarCloudMaker maker;
  maker.addGround();
  // The shadow of the nearer one begins at y = 1.06, where the farther one's rear is.
  addBox(maker, {Pose2(20.0, -1.5, kPi / 2.0), 5.0, 2.0}, 2.0);
  addBox(maker, {Pose2(8.0, 1.2, 0.0), 1.0, 1.6}, 2.5);
  const CloudObjects found = detect(maker);
  const auto& objects = found.list.objects;
  ASSERT_GE(objects.size(), 2U);
  const auto hidden = [](const Object& object) {
    return object.box.center.x() > 15.0 &&
           std::count(object.side_variance.begin(), object.side_variance.end(), kHiddenSide) > 1;
  };
  EXPECT_TRUE(std::any_of(objects.begin(), objects.end(), hidden));
}

TEST(CloudObjectDetectorTest, TheGroundAndTheVehicleItselfAreNoObjects) {
  LidarCloudMaker maker;
  maker.addGround();
  for (int i = 0; i < 100; ++i) {
    maker.add(0.3, -0.4 + 0.008 * i, 1.0);
  }
  const CloudObjects found = detect(maker);
  EXPECT_TRUE(found.list.objects.empty());
  EXPECT_EQ(found.own_points, 100U);
  EXPECT_EQ(found.points, 0U);
}

TEST(CloudObjectDetectorTest, WallsAndSignsAreNoObjects) {
  LidarCloudMaker maker;
  maker.addGround();
  for (int i = 0; i < 400; ++i) {
    for (int row = 0; row < 10; ++row) {
      maker.add(-10.0 + 0.05 * i, 8.0, 0.5 + 0.1 * row);
    }
  }
  for (int i = 0; i < 100; ++i) {
    maker.add(12.0, -0.5 + 0.01 * i, 4.5);
  }
  const CloudObjects found = detect(maker);
  EXPECT_TRUE(found.list.objects.empty());
  EXPECT_EQ(found.too_large, 1U);
}

TEST(CloudObjectDetectorTest, AnObjectAcrossTheSeamBehindIsOneObject) {
  LidarCloudMaker maker;
  maker.addGround();
  addBox(maker, {Pose2(-12.0, 0.0, 0.0), 4.2, 1.8}, 1.5);
  const CloudObjects found = detect(maker);
  ASSERT_EQ(found.list.objects.size(), 1U);
  EXPECT_NEAR(found.list.objects.front().box.center.y(), 0.0, 0.15);
}

TEST(CloudObjectDetectorTest, PointsAreCompensatedForTheVehiclesMotion) {
  // The vehicle drives at 10 m/s toward a wall at x = 10; its second half is seen 0.1 s later, 1 m
  // nearer.
  LidarCloudMaker maker;
  for (int half = 0; half < 2; ++half) {
    for (int i = 0; i < 20; ++i) {
      for (int row = 0; row < 10; ++row) {
        maker.add(10.0 - half, (half == 0 ? -1.0 : 0.0) + 0.05 * i, 0.5 + 0.1 * row);
        maker.cloud.times.push_back(0.1F * static_cast<float>(half));
      }
    }
  }
  const CloudObjects found = detect(maker, Twist2{10.0, 0.0});
  ASSERT_EQ(found.list.objects.size(), 1U);
  const Object& object = found.list.objects.front();
  for (const Point2& point : object.points) {
    EXPECT_NEAR(point.x(), 10.0, 0.01);
  }
  EXPECT_NEAR(object.delay, 0.05, 0.005);
}

TEST(CloudObjectDetectorTest, AnEmptyCloudHasNone) {
  const CloudObjects found = detect(LidarCloudMaker());
  EXPECT_TRUE(found.list.objects.empty());
  EXPECT_EQ(found.list.stamp, Stamp::fromSeconds(100.0));
}

TEST(CloudObjectDetectorTest, TheSameCloudGivesTheSameObjects) {
  LidarCloudMaker maker;
  maker.addGround();
  addBox(maker, kCarAhead, 1.5);
  const CloudObjects one = detect(maker);
  const CloudObjects other = detect(maker);
  ASSERT_EQ(one.list.objects.size(), other.list.objects.size());
  EXPECT_EQ(one.list.objects.front().box.center.x(), other.list.objects.front().box.center.x());
}

TEST(CloudObjectDetectorTest, OptionsThatContradictEachOtherAreRefused) {
  CloudObjectDetectorOptions options;
  options.min_height = 1.5;
  options.max_height = 1.0;
  EXPECT_THROW(CloudObjectDetector{options}, OptionError);
  options = CloudObjectDetectorOptions();
  options.max_range = 300.0;
  options.voxel_size = 0.1;
  EXPECT_THROW(CloudObjectDetector{options}, OptionError) << "more voxels than memory holds";
  options = CloudObjectDetectorOptions();
  options.cluster_distance = options.voxel_size;
  EXPECT_THROW(CloudObjectDetector{options}, OptionError);
}

}  // namespace
}  // namespace datmo::cloud_object_detector_test
