// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/fusion/object/object_fuser.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "fusion_objects.h"
#include <gtest/gtest.h>

#include "datmo_fusion/common/class_belief.h"
#include "datmo_fusion/tracking/object_check.h"

namespace datmo::object_fuser_test {
namespace {

/// Everything within 40 m in front of the vehicle.
SensorView ahead(const std::string& sensor) {
  return {sensor, {Pose2(1.0, 0.0, 0.0), -0.6, 0.6, 40.0, 50.0}};
}

Object poleAt(double x, double y, double probability) {
  Object object = pointObject(x, y, 0.3, "stereo");
  object.class_probabilities = reportedClass(ObjectClass::kPole, probability);
  return object;
}

ObjectFusionResult fuse(const std::vector<SourceObjects>& sources,
                        const LabeledScan* scan = nullptr) {
  return ObjectFuser(ObjectFuserOptions()).fuse(sources, scan);
}

TEST(ObjectFuserTest, PairsAreFusedAndAllOthersKept) {
  const auto [list, counts] =
      fuse({received("lidar", {pointObject(10.0, 0.0, 0.1), pointObject(30.0, 8.0, 0.1)}),
            received("stereo", {pointObject(10.4, 0.1, 0.5, "stereo"),
                                pointObject(15.0, -6.0, 0.5, "stereo")})});
  ASSERT_EQ(list.objects.size(), 3U);
  EXPECT_EQ(counts.fused, 1U);
  EXPECT_EQ(list.stamp, kReference);
  EXPECT_EQ(list.objects[0].sensors, (std::vector<std::string>{"lidar", "stereo"}));
  EXPECT_EQ(list.objects[1].sensors, std::vector<std::string>{"lidar"});
  EXPECT_EQ(list.objects[2].sensors, std::vector<std::string>{"stereo"});
  for (const Object& object : list.objects) {
    EXPECT_TRUE(isValid(object));
  }
}

TEST(ObjectFuserTest, ListsAreMovedToTheStampOfTheReference) {
  // In 0.05 s the vehicle drove 1 m: the older list has a pole 1 m farther away.
  SourceObjects stereo =
      received("stereo", {pointObject(11.0, 0.0, 0.1, "stereo")}, 4.95, Pose2(-1.0, 0.0, 0.0));
  stereo.list.objects[0].delay = 0.01;
  stereo.list.views = {ahead("stereo")};
  const auto alone = fuse({received("lidar", {}), stereo}).list;
  ASSERT_EQ(alone.objects.size(), 1U);
  EXPECT_NEAR(alone.objects[0].box.center.x(), 10.0, 1e-9);
  EXPECT_NEAR(alone.objects[0].delay, -0.04, 1e-9);
  ASSERT_EQ(alone.views.size(), 1U);
  EXPECT_NEAR(alone.views[0].field.sensor_in_base.x(), 0.0, 1e-9);
  const auto both = fuse({received("lidar", {pointObject(10.0, 0.0, 0.1)}), stereo}).list;
  ASSERT_EQ(both.objects.size(), 1U);
  EXPECT_NEAR(both.objects[0].delay, -0.02, 1e-6);
}

TEST(ObjectFuserTest, OrderOfTheObjectsDoesNotMatter) {
  std::vector<Object> lidar;
  std::vector<Object> stereo;
  for (int i = 0; i < 10; ++i) {
    lidar.push_back(pointObject(10.0 + i, 0.1 * i, 0.1));
    stereo.push_back(pointObject(10.3 + i, 0.1 * i, 0.4, "stereo"));
  }
  const auto expected = fuse({received("lidar", lidar), received("stereo", stereo)}).list;
  std::reverse(lidar.begin(), lidar.end());
  std::rotate(stereo.begin(), stereo.begin() + 3, stereo.end());
  const auto list = fuse({received("lidar", lidar), received("stereo", stereo)}).list;
  ASSERT_EQ(list.objects.size(), expected.objects.size());
  for (std::size_t i = 0; i < list.objects.size(); ++i) {
    EXPECT_EQ(list.objects[i].box.center.position(), expected.objects[i].box.center.position());
    EXPECT_EQ(list.objects[i].sensors, expected.objects[i].sensors);
  }
}

TEST(ObjectFuserTest, AThirdSourceJoinsAPair) {
  ObjectFuserOptions options;
  options.sources["radar"];
  const std::vector<SourceObjects> sources = {
      received("lidar", {pointObject(10.0, 0.0, 0.1)}),
      received("radar",
               {pointObject(10.1, 0.0, 0.3, "radar"), pointObject(40.0, 0.0, 0.3, "radar")}),
      received("stereo", {pointObject(10.2, 0.0, 0.5, "stereo")})};
  const auto [list, counts] = ObjectFuser(options).fuse(sources, nullptr);
  ASSERT_EQ(list.objects.size(), 2U);
  EXPECT_EQ(counts.fused, 1U);
  EXPECT_EQ(list.objects[0].sensors, (std::vector<std::string>{"lidar", "radar", "stereo"}));
}

TEST(ObjectFuserTest, SeenByTwoIsLikelierToBeAnObject) {
  ObjectFuserOptions options;
  options.sources["stereo"].detection_probability = 0.6;
  options.sources["stereo"].false_agreement_probability = 0.1;
  const auto list = ObjectFuser(options)
                        .fuse({received("lidar", {pointObject(10.0, 0.0, 0.1)}),
                               received("stereo", {pointObject(10.0, 0.0, 0.3, "stereo")})},
                              nullptr)
                        .list;
  ASSERT_EQ(list.objects.size(), 1U);
  EXPECT_NEAR(list.objects[0].log_odds, std::log(6.0), 1e-9);
}

TEST(ObjectFuserTest, MissedByAnotherInItsViewIsLessLikely) {
  ObjectFuserOptions options;
  options.sources["stereo"].detection_probability = 0.6;
  SourceObjects stereo = received("stereo", {boxObject(20.0, 0.0, 2.0, 2.0, 0.01, "stereo")});
  const std::vector<Object> lidar = {pointObject(10.0, 2.0, 0.1),   // in its view
                                     pointObject(10.0, 20.0, 0.1),  // outside
                                     pointObject(30.0, 0.0, 0.1)};  // behind what it saw
  const ObjectFuser fuser(options);
  const auto not_known = fuser.fuse({received("lidar", lidar), stereo}, nullptr).list;
  stereo.list.views = {ahead("stereo")};
  const auto list = fuser.fuse({received("lidar", lidar), stereo}, nullptr).list;
  ASSERT_EQ(list.objects.size(), 4U);
  const double seen = options.visibility.max_probability;
  const double hidden = options.visibility.min_probability;
  for (const Object& object : not_known.objects) {
    EXPECT_EQ(object.log_odds, 0.0);
  }
  EXPECT_NEAR(list.objects[0].log_odds, std::log(1.0 - 0.6 * seen), 1e-9);
  EXPECT_NEAR(list.objects[1].log_odds, std::log(1.0 - 0.6 * hidden), 1e-9);
  EXPECT_NEAR(list.objects[2].log_odds, std::log(1.0 - 0.6 * hidden), 1e-9);
}

TEST(ObjectFuserTest, TheScanShowsWhatTheScannerDoesNotList) {
  const std::vector<SourceObjects> sources = {
      received("lidar", {}), received("stereo", {boxObject(20.0, 0.0, 1.0, 2.0, 0.01, "stereo")})};
  const LabeledScan on_static = scanAhead(19.5, PointState::kStatic);
  const Object standing = fuse(sources, &on_static).list.objects.at(0);
  EXPECT_EQ(standing.dynamic_state, DynamicState::kStatic);
  EXPECT_EQ(standing.log_odds, 0.0);
  const LabeledScan behind = scanAhead(40.0, PointState::kStatic);
  const Object doubtful = fuse(sources, &behind).list.objects.at(0);
  EXPECT_EQ(doubtful.dynamic_state, DynamicState::kUnknown);
  EXPECT_NEAR(doubtful.log_odds, std::log(1.0 - 0.8), 1e-9);
  const LabeledScan before = scanAhead(10.0, PointState::kStatic);
  const Object hidden = fuse(sources, &before).list.objects.at(0);
  EXPECT_EQ(hidden.dynamic_state, DynamicState::kUnknown);
  EXPECT_EQ(hidden.log_odds, 0.0);
}

TEST(ObjectFuserTest, FewMovingPointsDoNotMakeAStaticObjectMove) {
  // 4 of 9 of the beams on what stereo sees end on static points: too few to conclude that it is
  // stationary.
  const SourceObjects stereo = received("stereo", {boxObject(20.0, 0.0, 1.0, 3.0, 0.04, "stereo")});
  LabeledScan scan = scanAhead(19.5, PointState::kStatic);
  for (ScanPoint& point : scan.points) {
    point.state = point.bearing > -degrees(0.5) ? PointState::kMoving : PointState::kStatic;
  }
  const auto fusedWith = [&](std::size_t points) {
    Object lidar = boxObject(19.5, 0.5, 0.0, 2.0, 0.04);
    hide(lidar, BoxSide::kFront);
    hide(lidar, BoxSide::kRight);
    lidar.dynamic_state = DynamicState::kMoving;
    lidar.moving_fraction = 1.0;
    lidar.points.assign(points, Point2(19.5, 0.5));
    return fuse({received("lidar", {lidar}), stereo}, &scan).list;
  };
  const auto max = fusedWith(5);
  ASSERT_EQ(max.objects.size(), 1U);
  EXPECT_EQ(max.objects[0].dynamic_state, DynamicState::kMoving);
  EXPECT_LT(max.objects[0].moving_fraction, 0.7);
  const auto little = fusedWith(1);
  ASSERT_EQ(little.objects.size(), 1U);
  EXPECT_EQ(little.objects[0].dynamic_state, DynamicState::kUnknown);
  EXPECT_LT(little.objects[0].moving_fraction, 0.3);
}

TEST(ObjectFuserTest, PolesAreStaticUnlessSeenMoving) {
  Object walker = pointObject(10.0, -5.0, 0.1);
  walker.dynamic_state = DynamicState::kMoving;
  const auto list = fuse({received("lidar", {walker}),
                          received("stereo", {poleAt(10.0, 0.0, 0.8), poleAt(10.0, 5.0, 0.4),
                                              poleAt(10.0, -5.0, 0.8)})})
                        .list;
  ASSERT_EQ(list.objects.size(), 3U);
  EXPECT_EQ(list.objects[0].dynamic_state, DynamicState::kMoving);
  EXPECT_EQ(list.objects[1].dynamic_state, DynamicState::kStatic);
  EXPECT_EQ(list.objects[2].dynamic_state, DynamicState::kUnknown);
}

TEST(ObjectFuserTest, ATableReplacesTheCovarianceOfTheObjects) {
  ObjectFuserOptions options;
  options.sources["stereo"].covariance.range_variance = {0.1, 0.2, 0.3};
  options.sources["stereo"].covariance.bearing_variance = {0.001, 0.002, 0.003};
  // Seen from 1 m ahead of the vehicle's origin, which has turned by a quarter since then.
  SourceObjects stereo = received("stereo", {pointObject(4.5, 0.0, 7.0, "stereo")}, 5.0,
                                  Pose2(0.0, 0.0, kQuarterTurn));
  stereo.list.views = {ahead("stereo")};
  const auto list = ObjectFuser(options).fuse({received("lidar", {}), stereo}, nullptr).list;
  ASSERT_EQ(list.objects.size(), 1U);
  EXPECT_NEAR(list.objects[0].position_covariance(1, 1), 0.2, 1e-9);
  EXPECT_NEAR(list.objects[0].position_covariance(0, 0), 0.002 * 3.5 * 3.5, 1e-9);
}

TEST(ObjectFuserTest, TablesOfDifferentLengthsAreRefused) {
  ObjectFuserOptions options;
  options.sources["stereo"].covariance.range_variance = {0.1, 0.2};
  options.sources["stereo"].covariance.bearing_variance = {0.001};
  EXPECT_THROW(ObjectFuser{options}, OptionError);
}

TEST(ObjectFuserTest, AScannerThatIsNotASourceIsRefused) {
  ObjectFuserOptions options;
  options.scanner = "laser";
  EXPECT_THROW(ObjectFuser{options}, OptionError);
  options.sources["laser"];
  EXPECT_NO_THROW(ObjectFuser{options});
}

TEST(ObjectFuserTest, InvalidObjectsAreCountedAndTheOthersKept) {
  std::vector<Object> stereo(6, pointObject(20.0, 0.0, 0.1, "stereo"));
  stereo[0].box.center = Pose2(std::numeric_limits<double>::quiet_NaN(), 0.0, 0.0);
  stereo[1].position_covariance.setZero();
  stereo[2].position_covariance << 1.0, 2.0, 2.0, 1.0;
  stereo[3].side_variance[0] = -1.0;
  stereo[4].log_odds = std::numeric_limits<double>::infinity();
  const auto [list, counts] =
      fuse({received("lidar", {pointObject(10.0, 0.0, 0.1)}), received("stereo", stereo)});
  EXPECT_EQ(counts.rejected, 5U);
  EXPECT_EQ(list.objects.size(), 2U);
}

TEST(ObjectFuserTest, OfAThousandObjectsTheNearestAreUsed) {
  std::vector<Object> lidar;
  for (int i = 0; i < 1000; ++i) {
    lidar.push_back(pointObject(0.1 * (1000 - i), 1.0, 0.01));
  }
  ObjectFuserOptions options;
  options.max_objects = 200;
  const auto [list, counts] =
      ObjectFuser(options).fuse({received("lidar", lidar), received("stereo", lidar)}, nullptr);
  EXPECT_EQ(counts.refused, 1600U);
  EXPECT_EQ(list.objects.size(), 200U);
  EXPECT_EQ(counts.fused, 200U);
  for (const Object& object : list.objects) {
    EXPECT_LE(object.box.center.x(), 20.0 + 1e-6);
  }
}

TEST(ObjectFuserTest, UnknownSourcesAreRefused) {
  EXPECT_THROW(fuse({received("sonar", {})}), std::out_of_range);
  EXPECT_THROW(fuse({}), std::out_of_range);
}

}  // namespace
}  // namespace datmo::object_fuser_test
