// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/fusion/object/object_association.h"

#include <cmath>
#include <vector>

#include "fusion_objects.h"
#include <gtest/gtest.h>

#include "datmo_fusion/assignment/assignment.h"
#include "datmo_fusion/common/angle.h"
#include "datmo_fusion/common/class_belief.h"

namespace datmo::object_association_test {
namespace {

ObjectAssociationOptions exact() {
  ObjectAssociationOptions options;
  options.body_std = 0.0;
  return options;
}

ObjectAssociationOptions nearest() {
  ObjectAssociationOptions options;
  options.association = ObjectAssociationMethod::kNearestNeighbor;
  return options;
}

Object classified(Object object, ObjectClass object_class, double probability) {
  object.class_probabilities = reportedClass(object_class, probability);
  return object;
}

TEST(ObjectAssociationTest, PointsAreComparedByTheSumOfTheirCovariances) {
  const ObjectPairing pair =
      pairing(pointObject(10.0, 0.0, 0.3), pointObject(10.5, 1.0, 0.4), exact());
  EXPECT_TRUE(pair.possible);
  EXPECT_NEAR(pair.squared_distance, 1.25 / 0.25, 1e-6);
  const double density = std::exp(-2.5) / (2.0 * kPi * 0.25);
  EXPECT_NEAR(pair.score, std::log(density / exact().unrelated_density), 1e-6);
}

TEST(ObjectAssociationTest, BeyondTheGateThereIsNoPair) {
  const Object a = pointObject(10.0, 0.0, 0.3);
  EXPECT_TRUE(pairing(a, pointObject(11.85, 0.0, 0.4), exact()).possible);
  EXPECT_FALSE(pairing(a, pointObject(11.86, 0.0, 0.4), exact()).possible);
}

TEST(ObjectAssociationTest, SidesAreComparedThatBothSaw) {
  // The scanner sees the rear of a truck, and a meter of its side; the other sensor sees all of it.
  Object part = boxObject(10.5, 0.0, 1.0, 2.0, 0.001);
  hide(part, BoxSide::kFront);
  Object whole = boxObject(14.0, 0.0, 8.0, 2.0, 0.001, "stereo");
  EXPECT_NEAR(pairing(part, whole, exact()).squared_distance, 0.0, 1e-6);
  part.side_variance[sideIndex(BoxSide::kFront)] = 0.001;
  EXPECT_FALSE(pairing(part, whole, exact()).possible);
}

TEST(ObjectAssociationTest, WithoutACommonSideTheSizeIsUnknown) {
  ObjectAssociationOptions options = exact();
  options.unknown_size_std = 1.0;
  // One end of a bus each, 3 m apart.
  Object left = boxObject(10.0, 3.0, 0.0, 2.0, 0.0);
  hide(left, BoxSide::kRight);
  Object right = boxObject(10.0, -2.0, 0.0, 2.0, 0.0, "stereo");
  hide(right, BoxSide::kLeft);
  EXPECT_NEAR(pairing(left, right, options).squared_distance, 9.0 / 1.02, 1e-3);
  // They agree in the overlap.
  right.box.center = Pose2(10.0, 2.0, 0.0);
  EXPECT_NEAR(pairing(left, right, options).squared_distance, 0.0, 1e-9);
}

TEST(ObjectAssociationTest, AGapBetweenSidesThatWereSeenIsNoUnknownSize) {
  // An echo of paint, and 4 m beside it a parked car, seen from the other side.
  Object echo = boxObject(10.0, 1.0, 0.3, 0.0, 0.02);
  hide(echo, BoxSide::kLeft);
  Object car = boxObject(10.2, -3.6, 0.3, 1.3, 0.02, "stereo");
  hide(car, BoxSide::kRight);
  EXPECT_FALSE(pairing(echo, car, ObjectAssociationOptions()).possible);
  EXPECT_FALSE(pairing(car, echo, ObjectAssociationOptions()).possible);
  // Either may fill the gap, as its end there is not visible.
  hide(car, BoxSide::kLeft);
  car.box.center = Pose2(10.2, -1.0, 0.0);
  EXPECT_TRUE(pairing(echo, car, ObjectAssociationOptions()).possible);
}

TEST(ObjectAssociationTest, PairingIsSymmetric) {
  Object a = boxObject(10.0, 3.0, 1.0, 2.0, 0.01);
  Object b = boxObject(10.2, 3.1, 2.0, 1.2, 0.02, "stereo");
  a.box.center = Pose2(a.box.center.position(), 0.3);
  b.box.center = Pose2(b.box.center.position(), -1.4);
  b.delay = 0.05;
  hide(b, BoxSide::kLeft);
  const ObjectAssociationOptions options;
  EXPECT_NEAR(pairing(a, b, options).score, pairing(b, a, options).score, 1e-9);
}

TEST(ObjectAssociationTest, MovingObjectsMayBeElsewhereAtAnotherTime) {
  const Object a = pointObject(10.0, 0.0, 0.05);
  Object b = pointObject(11.0, 0.0, 0.05, "stereo");
  EXPECT_FALSE(pairing(a, b, exact()).possible);
  b.delay = -0.1;
  EXPECT_NEAR(pairing(a, b, exact()).squared_distance, 1.0 / 1.005, 1e-6);
  b.dynamic_state = DynamicState::kStatic;
  EXPECT_FALSE(pairing(a, b, exact()).possible);
}

TEST(ObjectAssociationTest, DifferentClassesAreDifferentObjects) {
  const Object plain = pointObject(10.0, 0.0, 0.1);
  const Object walker = classified(plain, ObjectClass::kPedestrian, 0.8);
  const ObjectAssociationOptions options;
  EXPECT_FALSE(pairing(walker, classified(plain, ObjectClass::kVehicle, 0.8), options).possible);
  EXPECT_TRUE(pairing(walker, classified(plain, ObjectClass::kVehicle, 0.4), options).possible);
  EXPECT_TRUE(pairing(classified(plain, ObjectClass::kVehicle, 0.4), walker, options).possible);
  EXPECT_TRUE(pairing(walker, walker, options).possible);
  EXPECT_TRUE(pairing(walker, plain, options).possible);
}

TEST(ObjectAssociationTest, TheAssignmentIsBestOverAllWhereTheNearestNeighborFails) {
  // Three in a row, 1 m apart; the other sensor sees all of them 0.6 m farther to the left, so that
  // each one except the last is nearer to the next.
  std::vector<Object> known;
  std::vector<Object> added;
  for (int i = 0; i < 3; ++i) {
    known.push_back(pointObject(20.0, i, 0.05));
    added.push_back(pointObject(20.0, i + 0.6, 0.5, "stereo"));
  }
  const std::vector<int> optimal =
      associate(known, added, Point2::Zero(), ObjectAssociationOptions());
  EXPECT_EQ(optimal, (std::vector<int>{0, 1, 2}));
  const std::vector<int> greedy = associate(known, added, Point2::Zero(), nearest());
  EXPECT_EQ(greedy, (std::vector<int>{1, 2, kUnassigned}));
}

TEST(ObjectAssociationTest, APairMustBeLikelierThanTwoObjects) {
  ObjectAssociationOptions options = exact();
  const std::vector<Object> known = {pointObject(10.0, 0.0, 0.6)};
  const std::vector<Object> added = {pointObject(12.0, 0.0, 0.8, "stereo")};
  options.unrelated_density = 0.01;  // where two are one: exp(-2) / (2 pi) = 0.0215 1/m^2
  EXPECT_EQ(associate(known, added, Point2::Zero(), options), std::vector<int>{0});
  options.unrelated_density = 0.03;
  EXPECT_EQ(associate(known, added, Point2::Zero(), options), std::vector<int>{kUnassigned});
}

TEST(ObjectAssociationTest, TheNearestNeighborIsThatOfTheThesis) {
  const std::vector<Object> known = {pointObject(18.0, 0.0, 0.1), pointObject(37.0, 0.0, 0.1)};
  const auto match = [&](double x, double y) {
    return associate(known, {pointObject(x, y, 0.1, "stereo")}, Point2::Zero(), nearest())[0];
  };
  // At 18 m up to 2.5 m.
  EXPECT_EQ(match(18.0, 2.4), 0);
  EXPECT_EQ(match(18.0, 2.7), kUnassigned);
  EXPECT_EQ(match(35.5, 0.0), 1);
  EXPECT_EQ(match(36.5, 0.0), kUnassigned);
}

TEST(ObjectAssociationTest, TheNearestNeighborComparesFrontSides) {
  // The scanner sees only the rear; the other sensor's car has its rear equally near.
  const std::vector<Object> known = {pointObject(10.0, 0.0, 0.1)};
  const std::vector<Object> added = {boxObject(12.5, 0.0, 5.0, 2.0, 0.01, "stereo")};
  EXPECT_EQ(associate(known, added, Point2::Zero(), nearest())[0], 0);
}

TEST(ObjectAssociationTest, OfTwoWithTheSameNearestNeighborTheNearerKeepsIt) {
  const std::vector<Object> known = {pointObject(20.0, 0.0, 0.1)};
  const std::vector<Object> added = {pointObject(20.0, 1.0, 0.1), pointObject(20.0, -0.5, 0.1),
                                     pointObject(20.0, 0.8, 0.1)};
  EXPECT_EQ(associate(known, added, Point2::Zero(), nearest()),
            (std::vector<int>{kUnassigned, 0, kUnassigned}));
}

TEST(ObjectAssociationTest, WithoutObjectsThereAreNoPairs) {
  const std::vector<Object> one = {pointObject(20.0, 0.0, 0.1)};
  EXPECT_TRUE(associate(one, {}, Point2::Zero(), ObjectAssociationOptions()).empty());
  EXPECT_EQ(associate({}, one, Point2::Zero(), nearest()), std::vector<int>{kUnassigned});
}

}  // namespace
}  // namespace datmo::object_association_test
