// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/vision/detection_association.h"

#include "vision/image_samples.h"
#include <gtest/gtest.h>

namespace datmo::detection_association_test {
namespace {

using test::detectionOf;
using test::levelCamera;
using test::objectAt;

ProjectedObject projected(const Object& object) {
  const auto region = regionOf(levelCamera(), object, 1.6, 0.4, 2.0);
  EXPECT_TRUE(region);
  return {region.value_or(ImageRegion()), object.box.distanceTo(Point2(0.0, 0.0)), 0.05};
}

/// The detection of an object of this height whose near face is at (x, y).
ImageDetection seenAt(double x, double y, double width, double height, ObjectClass object_class) {
  const double middle = 500.0 - 500.0 * y / x;
  const double feet = 200.0 + 500.0 * test::kCameraHeight / x;
  const double half = 250.0 * width / x;
  return detectionOf(object_class, middle - half, feet - 500.0 * height / x, middle + half, feet);
}

std::vector<std::optional<std::size_t>> associated(const std::vector<ProjectedObject>& objects,
                                                   const std::vector<ImageDetection>& detections) {
  return associate(objects, detections, levelCamera(), ImageRangeOptions(),
                   DetectionAssociationOptions());
}

TEST(DetectionAssociation, EachObjectGetsItsOwn) {
  const auto matches = associated({projected(objectAt(10.0, 2.0, 0.5, 0.5, 0.0)),
                                   projected(objectAt(10.0, -2.0, 0.5, 0.5, 0.0))},
                                  {seenAt(9.75, -2.0, 0.6, 1.7, ObjectClass::kPedestrian),
                                   seenAt(9.75, 2.0, 0.6, 1.7, ObjectClass::kPedestrian)});
  EXPECT_EQ(matches[0], 1U);
  EXPECT_EQ(matches[1], 0U);
}

TEST(DetectionAssociation, AnObjectBehindIsAnother) {
  const auto near = projected(objectAt(8.0, 0.0, 0.5, 0.5, 0.0));
  const auto far = projected(objectAt(30.0, 0.0, 0.5, 0.5, 0.0));
  const auto matches =
      associated({far, near}, {seenAt(7.75, 0.0, 0.6, 1.7, ObjectClass::kPedestrian)});
  EXPECT_FALSE(matches[0]);
  EXPECT_EQ(matches[1], 0U);
}

TEST(DetectionAssociation, AnObjectBesideIsAnother) {
  const auto matches = associated({projected(objectAt(10.0, 3.0, 0.5, 0.5, 0.0))},
                                  {seenAt(9.75, 0.0, 0.6, 1.7, ObjectClass::kPedestrian)});
  EXPECT_FALSE(matches[0]);
}

TEST(DetectionAssociation, PiecesOfAVehicleAreSeenAsOne) {
  const auto van = seenAt(12.0, 0.0, 1.9, 1.8, ObjectClass::kVehicle);
  const auto matches = associated({projected(objectAt(12.2, 0.6, 0.4, 0.4, 0.0)),
                                   projected(objectAt(12.2, -0.6, 0.4, 0.4, 0.0))},
                                  {van});
  EXPECT_EQ(matches[0], 0U);
  EXPECT_EQ(matches[1], 0U);
}

TEST(DetectionAssociation, APersonIsOneObjectAlone) {
  const auto person = seenAt(9.75, 0.0, 1.0, 1.7, ObjectClass::kPedestrian);
  const auto matches = associated({projected(objectAt(10.0, 0.05, 0.4, 0.4, 0.0)),
                                   projected(objectAt(10.0, 0.3, 0.2, 0.2, 0.0))},
                                  {person});
  EXPECT_EQ(matches[0], 0U);
  EXPECT_FALSE(matches[1]);
}

TEST(DetectionAssociation, OfNoObjectsIsEmpty) {
  EXPECT_TRUE(associated({}, {seenAt(10.0, 0.0, 0.6, 1.7, ObjectClass::kPedestrian)}).empty());
  const auto matches = associated({projected(objectAt(10.0, 0.0, 0.5, 0.5, 0.0))}, {});
  ASSERT_EQ(matches.size(), 1U);
  EXPECT_FALSE(matches[0]);
}

}  // namespace
}  // namespace datmo::detection_association_test
