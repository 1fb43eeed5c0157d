// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/vision/image_region.h"

#include "vision/image_samples.h"
#include <gtest/gtest.h>

namespace datmo::image_region_test {
namespace {

using test::levelCamera;
using test::objectAt;

constexpr double kSigmas = 2.0;

TEST(ImageRegion, ABoxByHand) {
  // Its near face 10 m ahead, 2 m wide, 1 m high: rows 200 + 500 * 1.5 / 10 and 200 + 25.
  const auto region = regionOf(levelCamera(), objectAt(11.0, 0.0, 2.0, 2.0, 1.0), 1.6, 0.4, 0.0);
  ASSERT_TRUE(region);
  EXPECT_NEAR(region->box.min().x(), 450.0, 1e-9);
  EXPECT_NEAR(region->box.max().x(), 550.0, 1e-9);
  EXPECT_NEAR(region->box.max().y(), 275.0, 1e-9);
  EXPECT_NEAR(region->box.min().y(), 200.0 + 500.0 * 0.5 / 12.0, 1e-9) << "of its far upper edge";
  EXPECT_NEAR(region->scale, 500.0 / 11.0, 1e-9);
}

TEST(ImageRegion, UncertaintyMakesRoomAroundTheBox) {
  Object object = objectAt(10.0, 0.0, 0.0, 2.0, 1.0);
  object.position_covariance << 0.0001, 0.0, 0.0, 0.25;  // half a meter to the side
  const auto region = regionOf(levelCamera(), object, 1.6, 1e-6, kSigmas);
  ASSERT_TRUE(region);
  EXPECT_NEAR(region->box.sizes().x(), 100.0, 0.1);
  EXPECT_NEAR(region->search.sizes().x(), 200.0, 0.5) << "1 m more on both sides";
  EXPECT_TRUE(region->search.contains(region->box));
}

TEST(ImageRegion, ObjectsOutsideTheImageHaveNone) {
  const MountedCamera camera = levelCamera();
  EXPECT_FALSE(regionOf(camera, objectAt(-10.0, 0.0, 4.0, 2.0, 1.5), 1.6, 0.4, kSigmas));
  EXPECT_FALSE(regionOf(camera, objectAt(10.0, 30.0, 4.0, 2.0, 1.5), 1.6, 0.4, kSigmas));
}

TEST(ImageRegion, ObjectsHalfOutsideAreCutAtTheBorder) {
  const auto region = regionOf(levelCamera(), objectAt(10.0, 10.0, 0.0, 2.0, 1.0), 1.6, 1e-6, 0.0);
  ASSERT_TRUE(region);
  EXPECT_NEAR(region->box.min().x(), 0.0, 1e-9);
  EXPECT_NEAR(region->box.max().x(), 50.0, 1e-3);
}

TEST(ImageRegion, AnObjectWithoutSizeHasTheMinimumOneAndTheDefaultHeight) {
  const auto region = regionOf(levelCamera(), objectAt(10.2, 0.0, 0.0, 0.0, 0.0), 1.5, 0.4, 0.0);
  ASSERT_TRUE(region);
  EXPECT_NEAR(region->box.sizes().x(), 20.0, 1e-9);
  EXPECT_NEAR(region->box.min().y(), 200.0, 1e-9) << "as high as the camera";
}

}  // namespace
}  // namespace datmo::image_region_test
