// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/detection/moving_object_detector.h"

#include <algorithm>
#include <cmath>

#include "ray_cast.h"
#include <gtest/gtest.h>

namespace datmo::moving_object_detector_test {
namespace {

/// A scan of 2-degree beams; each entry is range, beam index and state.
struct End {
  double range;
  std::uint32_t beam;
  PointState state;
};

LabeledScan labeledScan(const std::vector<End>& ends) {
  LabeledScan scan;
  scan.stamp = Stamp::fromSeconds(5.0);
  scan.field = {degrees(-80.0), degrees(2.0), 181, 0.5, 60.0, 80.0};
  for (const End& end : ends) {
    ScanPoint point;
    point.range = end.range;
    point.beam = end.beam;
    point.bearing = degrees(-80.0 + 2.0 * end.beam);
    point.position = end.range * Point2(std::cos(point.bearing), std::sin(point.bearing));
    point.state = end.state;
    scan.points.push_back(point);
  }
  return scan;
}

constexpr PointState kS = PointState::kStatic;
constexpr PointState kM = PointState::kMoving;
constexpr PointState kU = PointState::kUnknown;

ObjectList detect(const LabeledScan& scan, const MovingObjectDetectorOptions& options = {}) {
  return MovingObjectDetector(options).detect(scan);
}

/// By direction in the world, of an object seen along x: near, far, left, right.
struct SeenSides {
  double near, far, left, right;  ///< m^2
};

SeenSides sidesAcross(const Object& object) {
  const auto [front, rear, left, right] = object.side_variance;
  // Its heading, in (-90, 90] degrees, is along x or to the left.
  return std::abs(object.box.center.heading()) < degrees(45.0)
             ? SeenSides{rear, front, left, right}
             : (object.box.center.heading() > 0.0 ? SeenSides{left, right, front, rear}
                                                  : SeenSides{right, left, rear, front});
}

TEST(MovingObjectDetectorTest, ObjectsWereSeenAtTheMeanTimeOfTheirBeams) {
  LabeledScan scan = labeledScan({{5.0, 40, kM}, {5.0, 41, kM}, {5.0, 42, kM}, {5.0, 120, kM}});
  EXPECT_EQ(detect(scan).objects.front().delay, 0.0);
  scan.field.beam_time = 1e-3;
  const ObjectList list = detect(scan);
  ASSERT_EQ(list.objects.size(), 2U);
  EXPECT_NEAR(list.objects[0].delay, 0.041, 1e-12);
  EXPECT_NEAR(list.objects[1].delay, 0.120, 1e-12);
}

TEST(MovingObjectDetectorTest, AnEmptyScanHasNoObjects) {
  const ObjectList list = detect(labeledScan({}));
  EXPECT_TRUE(list.objects.empty());
  EXPECT_EQ(list.stamp, Stamp::fromSeconds(5.0));
}

TEST(MovingObjectDetectorTest, StaticPointsAreNoObject) {
  EXPECT_TRUE(detect(labeledScan({{10.0, 40, kS}, {10.0, 41, kS}})).objects.empty());
}

TEST(MovingObjectDetectorTest, MovingAndUnknownSegmentsAreReported) {
  const ObjectList list =
      detect(labeledScan({{10.0, 10, kM}, {10.0, 11, kM}, {20.0, 40, kU}, {20.0, 41, kU}}));
  ASSERT_EQ(list.objects.size(), 2U);
  EXPECT_EQ(list.objects[0].dynamic_state, DynamicState::kMoving);
  EXPECT_DOUBLE_EQ(list.objects[0].moving_fraction, 1.0);
  EXPECT_EQ(list.objects[1].dynamic_state, DynamicState::kUnknown);
  EXPECT_EQ(list.objects[0].points.size(), 2U);
  EXPECT_EQ(list.objects[0].sensors, std::vector<std::string>{"lidar"});
}

TEST(MovingObjectDetectorTest, AScannerThatTurnsToTheRightSeesTheSameObjects) {
  LabeledScan left = labeledScan({{12.0, 10, kM},
                                  {11.9, 11, kM},
                                  {20.0, 40, kU},
                                  {20.5, 41, kU},
                                  {21.2, 42, kM},
                                  {30.0, 60, kS}});
  left.field.beams = 81;
  LabeledScan right = left;
  std::reverse(right.points.begin(), right.points.end());
  for (ScanPoint& point : right.points) {
    point.beam = 80 - point.beam;
  }
  right.field = {degrees(80.0), degrees(-2.0), 81, 0.5, 60.0, 80.0};
  const ObjectList expected = detect(left);
  ObjectList list = detect(right);
  ASSERT_EQ(expected.objects.size(), 2U);
  ASSERT_EQ(list.objects.size(), 2U);
  std::reverse(list.objects.begin(), list.objects.end());
  for (std::size_t i = 0; i < 2; ++i) {
    const Object& one = expected.objects[i];
    const Object& other = list.objects[i];
    EXPECT_EQ(one.dynamic_state, other.dynamic_state);
    EXPECT_TRUE(one.box.center.position().isApprox(other.box.center.position(), 1e-9));
    EXPECT_NEAR(one.box.center.heading(), other.box.center.heading(), 1e-9);
    EXPECT_NEAR(one.box.length, other.box.length, 1e-9);
    EXPECT_NEAR(one.heading_variance, other.heading_variance, 1e-9);
    for (std::size_t side = 0; side < kBoxSides; ++side) {
      EXPECT_EQ(std::isfinite(one.side_variance[side]), std::isfinite(other.side_variance[side]));
      if (std::isfinite(one.side_variance[side])) {
        EXPECT_NEAR(one.side_variance[side], other.side_variance[side], 1e-9);
      }
    }
  }
}

TEST(MovingObjectDetectorTest, TheThesisUsesAnyMovingPoint) {
  const LabeledScan scan =
      labeledScan({{10.0, 40, kM}, {10.0, 41, kU}, {10.0, 42, kU}, {10.0, 43, kU}});
  EXPECT_EQ(detect(scan).objects.at(0).dynamic_state, DynamicState::kUnknown);
  MovingObjectDetectorOptions thesis;
  thesis.moving_share = 0.0;
  EXPECT_EQ(detect(scan, thesis).objects.at(0).dynamic_state, DynamicState::kMoving);
}

TEST(MovingObjectDetectorTest, AStaticPointNextToAMoverDoesNotHideIt) {
  const ObjectList list = detect(labeledScan({{10.0, 40, kM}, {10.2, 41, kS}, {10.1, 42, kM}}));
  ASSERT_EQ(list.objects.size(), 1U);
  EXPECT_EQ(list.objects[0].points.size(), 2U);
}

TEST(MovingObjectDetectorTest, AnAttachmentToAWallIsPartOfIt) {
  const ObjectList list =
      detect(labeledScan({{10.0, 40, kU}, {10.0, 41, kU}, {10.0, 42, kS}, {10.0, 43, kS}}));
  ASSERT_EQ(list.objects.size(), 1U);
  EXPECT_EQ(list.objects[0].dynamic_state, DynamicState::kStatic);
  EXPECT_EQ(list.objects[0].points.size(), 2U);
}

TEST(MovingObjectDetectorTest, AMoverNextToAWallIsStillReported) {
  const ObjectList list =
      detect(labeledScan({{10.0, 40, kM}, {10.0, 41, kM}, {10.0, 42, kS}, {10.0, 43, kS}}));
  ASSERT_EQ(list.objects.size(), 1U);
  EXPECT_EQ(list.objects[0].dynamic_state, DynamicState::kMoving);
}

TEST(MovingObjectDetectorTest, AHedgeIsNoObject) {
  std::vector<End> hedge;
  for (std::uint32_t beam = 0; beam < 81; ++beam) {
    hedge.push_back({15.0, beam, kU});
  }
  EXPECT_TRUE(detect(labeledScan(hedge)).objects.empty());
}

TEST(MovingObjectDetectorTest, APointIsASideOfOneSpacing) {
  // Beam 40 looks along x.
  const Object object = detect(labeledScan({{20.0, 40, kM}})).objects.at(0);
  const double spacing = 20.0 * std::tan(degrees(2.0));
  EXPECT_TRUE(object.box.center.position().isApprox(Point2(20.0, 0.0), 1e-9));
  EXPECT_NEAR(object.box.length, spacing, 1e-9) << "expected: none to two of them";
  EXPECT_NEAR(object.box.width, 0.0, 1e-9);
  const SeenSides sides = sidesAcross(object);
  EXPECT_NEAR(sides.near, 0.1 * 0.1, 1e-9);
  EXPECT_EQ(sides.far, kHiddenSide);
  EXPECT_GT(sides.left, spacing * spacing / 12.0);
  EXPECT_NEAR(sides.left, sides.right, 1e-9);
}

TEST(MovingObjectDetectorTest, AnEndBehindSomethingNearerIsHidden) {
  const std::vector<End> rear = {{20.0, 39, kM}, {19.98, 40, kM}, {20.0, 41, kM}};
  const SeenSides open = sidesAcross(detect(labeledScan(rear)).objects.at(0));
  EXPECT_TRUE(std::isfinite(open.left) && std::isfinite(open.right));
  std::vector<End> behind_a_tree = rear;
  behind_a_tree.push_back({8.0, 42, kS});
  const SeenSides hidden = sidesAcross(detect(labeledScan(behind_a_tree)).objects.at(0));
  EXPECT_EQ(hidden.left, kHiddenSide);
  EXPECT_TRUE(std::isfinite(hidden.right));
  EXPECT_TRUE(std::isfinite(hidden.near));
  EXPECT_EQ(hidden.far, kHiddenSide);
}

TEST(MovingObjectDetectorTest, TwoSidesOfACarGiveItsWholeBox) {
  Random random(1);
  RayCaster scanner(degrees(120.0), degrees(0.25), 0.0);
  const Box2 car{Pose2(15.0, 6.0, degrees(10.0)), 4.4, 1.8};
  const Object object = detect(scanner.scan({car}, random)).objects.at(0);
  EXPECT_NEAR(object.box.center.heading(), degrees(10.0), degrees(0.2));
  EXPECT_LT((object.box.center.position() - car.center.position()).norm(), 0.1);
  EXPECT_NEAR(object.box.length, 4.4, 0.2);
  EXPECT_NEAR(object.box.width, 1.8, 0.1);
  for (const double variance : object.side_variance) {
    EXPECT_TRUE(std::isfinite(variance));
  }
  const auto [front, rear, left, right] = object.side_variance;
  EXPECT_LT(rear, front) << "the front is where the side ends";
  EXPECT_LT(right, left) << "the left is where the rear ends";
}

/// Over random positions of a box, the mean of (error of a side)^2 / its variance, of the visible
/// sides.
double sideNees(const RayCaster& scanner, double length, double width) {
  MovingObjectDetectorOptions options;
  options.range_sigma = scanner.range_sigma;
  options.position_sigma = 0.01;  // rectangles, all at one time
  const MovingObjectDetector detector(options);
  Random random(3);
  double sum = 0.0;
  int sides = 0;
  for (int i = 0; i < 1000; ++i) {
    const double bearing = random.uniform(-1.0, 1.0);
    const Point2 position =
        random.uniform(6.0, 25.0) * Point2(std::cos(bearing), std::sin(bearing));
    const Box2 truth{Pose2(position, random.uniform(-kPi, kPi)), length, width};
    const std::vector<Object> objects = detector.detect(scanner.scan({truth}, random)).objects;
    if (objects.size() != 1) {
      continue;  // seen in pieces
    }
    constexpr std::array<double, kBoxSides> kDirections = {0.0, kPi, 0.5 * kPi, -0.5 * kPi};
    for (std::size_t side = 0; side < kBoxSides; ++side) {
      const double variance = objects[0].side_variance[side];
      if (!std::isfinite(variance)) {
        continue;
      }
      // Where the side's normal through its middle leaves the true box.
      const Box2& box = objects[0].box;
      const double direction = box.center.heading() + kDirections[side];
      const double reach = 0.5 * (side < 2 ? box.length : box.width);
      const double turn = std::round(angleBetween(truth.center.heading(), direction) / kPi * 2.0);
      const double true_reach = 0.5 * (std::fmod(std::abs(turn), 2.0) < 0.5 ? length : width);
      const double normal = truth.center.heading() + turn * 0.5 * kPi;
      const Point2 middle =
          box.center.position() + reach * Point2(std::cos(direction), std::sin(direction));
      const double error =
          Point2(std::cos(normal), std::sin(normal)).dot(middle - position) - true_reach;
      sum += error * error / (variance + options.position_sigma * options.position_sigma);
      ++sides;
    }
  }
  EXPECT_GT(sides, 1500);
  return sum / sides;
}

TEST(MovingObjectDetectorTest, SidesAreAsGoodAsTheirVariance) {
  const RayCaster fine(degrees(180.0), degrees(0.25), 0.03);
  const RayCaster coarse(degrees(180.0), degrees(2.0), 0.2);
  for (const RayCaster& scanner : {fine, coarse}) {
    for (const auto& [length, width] : {std::pair(4.4, 1.8), std::pair(1.8, 0.6)}) {
      const double nees = sideNees(scanner, length, width);
      EXPECT_LT(nees, 2.0) << length << " m, noise " << scanner.range_sigma;
      EXPECT_GT(nees, 0.3) << length << " m, noise " << scanner.range_sigma;
    }
  }
}

TEST(MovingObjectDetectorTest, HeadingIsMoreCertainForLongerObjects) {
  const double pair = detect(labeledScan({{10.0, 38, kM}, {10.0, 39, kM}, {10.0, 40, kM}}))
                          .objects[0]
                          .heading_variance;
  const double wide =
      detect(labeledScan(
                 {{10.0, 38, kM}, {10.0, 39, kM}, {10.0, 40, kM}, {10.0, 41, kM}, {10.0, 42, kM}}))
          .objects[0]
          .heading_variance;
  EXPECT_LT(wide, pair);
}

TEST(MovingObjectDetectorTest, RefusesBadOptions) {
  MovingObjectDetectorOptions options;
  options.segmentation.max_gap = -2.0;
  EXPECT_THROW(MovingObjectDetector{options}, OptionError);
}

}  // namespace
}  // namespace datmo::moving_object_detector_test
